#include "sim/link_experiment/answer_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "sim/columns/validity_column.hpp"
#include "sim/link/validity.hpp"
#include "sim/result/crossing_text.hpp"
#include "sim/result/place_text.hpp"
#include "sim/scenario/flags.hpp"

namespace sim {
namespace {

using Kind = Crossing::Kind;

/// "A, B and C".
std::string with_and(const std::vector<std::string>& names) {
  if (names.size() < 2) return names.empty() ? "" : names.front();
  const auto last = names.end() - 1;
  return fmt::format("{} and {}", fmt::join(names.begin(), last, ", "), *last);
}

bool is_told(const Crossing& c) {
  return c.kind != Kind::unfinished && c.kind != Kind::unclear && c.kind != Kind::not_monotone;
}

/// Rows whose links stand equal.
using Rows = std::vector<const RowCrossing*>;

class Answer {
 public:
  Answer(const LinkResult& result, const Ranking& ranking)
      : result_(result), ranking_(ranking), axis_(result.axes[ranking.abscissa]) {
    for (const RowCrossing& row : ranking.rows)
      if (is_told(row.crossing)) told_.push_back(&row);
    std::ranges::stable_sort(told_, std::greater<>(), &RowCrossing::merit);
  }

  std::string sentence() const {
    if (told_.empty()) return "";
    const Rows best = equals_at(0);
    if (best.size() == told_.size()) return all_alike(best) + untold();
    std::string text =
        fmt::format("{} {} {}: {}", names_of(best), best.size() == 1 ? verb() : verb_of_many(),
                    superlative(), reach_at_level(best));
    const Rows next = equals_at(best.size());
    if (best.size() + next.size() < told_.size()) text += "; next " + entry_of(next);
    const Rows last = equals_of_last();
    return text + "; last " + entry_of(last) + ".\n" + untold();
  }

 private:
  bool is_distance() const { return axis_.key == distance_key; }
  const char* verb() const {
    return is_distance() ? "reaches" : ranking_.more_is_better ? "needs" : "bears";
  }
  const char* verb_of_many() const {
    return is_distance() ? "reach" : ranking_.more_is_better ? "need" : "bear";
  }
  std::string superlative() const {
    if (is_distance()) return "furthest";
    return (ranking_.more_is_better ? "least of " : "most of ") + axis_.key;
  }

  Rows equals_at(std::size_t begin) const {
    Rows equal;
    for (std::size_t i = begin; i < told_.size() && told_[i]->merit == told_[begin]->merit; ++i)
      equal.push_back(told_[i]);
    return equal;
  }
  Rows equals_of_last() const {
    Rows equal;
    for (const RowCrossing* row : told_)
      if (row->merit == told_.back()->merit) equal.push_back(row);
    return equal;
  }

  std::string names_of(const Rows& rows) const {
    constexpr std::size_t few = 3;
    if (rows.size() > few) return fmt::format("{} of {} links", rows.size(), told_.size());
    std::vector<std::string> names;
    for (const RowCrossing* row : rows) names.push_back(link_words(result_, ranking_, *row));
    return with_and(names);
  }

  std::string reach_of(const Rows& rows) const {
    return short_crossing_words(axis_, rows.front()->crossing, ranking_.more_is_better);
  }

  /// Of one link with what is not sure of it: its model, and its part.
  std::string reach_at_level(const Rows& rows) const {
    std::string words = fmt::format("{} at {:g} % frame loss", reach_of(rows), 100 * ranking_.flr);
    if (rows.size() > 1) return words;
    const RowCrossing& row = *rows.front();
    std::vector<std::string> notes;
    if (row.validity_flags != 0)
      notes.push_back(fmt::format("{}: {}", validity_words,
                                  raised_names(validity_limits(), row.validity_flags)));
    if (row.doubt) notes.push_back(span_words(axis_, row.doubt->quantiles) + " for 8 of 10 units");
    return notes.empty() ? words : fmt::format("{} ({})", words, fmt::join(notes, "; "));
  }

  std::string entry_of(const Rows& rows) const { return names_of(rows) + ", " + reach_of(rows); }

  std::string all_alike(const Rows& rows) const {
    const std::string all = rows.size() == 1
                                ? names_of(rows) + " " + verb()
                                : fmt::format("All {} links {}", rows.size(), verb_of_many());
    return fmt::format("{} {}{}.\n", all, is_distance() ? "" : axis_.key + " ",
                       reach_at_level(rows));
  }

  std::string untold() const {
    const std::size_t others = ranking_.rows.size() - told_.size();
    if (others == 0) return "";
    return fmt::format("Of {} more {} this cannot be told.\n", others,
                       others == 1 ? "link" : "links");
  }

  const LinkResult& result_;
  const Ranking& ranking_;
  const Axis& axis_;
  Rows told_;  // the best first
};

}  // namespace

std::string link_words(const LinkResult& result, const Ranking& ranking, const RowCrossing& row) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < ranking.others.size(); ++i) {
    const Axis& axis = result.axes[ranking.others[i]];
    const std::string value = coordinate_text(axis, row.others[i]);
    words.push_back(axis.is_text() ? value : quantity(axis, value));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string answer_sentence(const LinkResult& result, const Ranking& ranking) {
  return ranking.rows.size() < 2 ? "" : Answer(result, ranking).sentence();
}

}  // namespace sim
