#include "sim/result/ranking.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "sim/link/validity.hpp"
#include "sim/result/crossing_text.hpp"
#include "sim/scenario/flags.hpp"

namespace sim {
namespace {

using Kind = Crossing::Kind;

/// The axes of a ranking, without its rows.
Ranking axes_of(const std::vector<Axis>& axes, const CrossingQuestion& question) {
  Ranking ranking{
      .abscissa = abscissa_of(axes, question.along), .others = {}, .flr = question.flr, .rows = {}};
  if (ranking.abscissa == Ranking::none) return ranking;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (i == ranking.abscissa) continue;
    ranking.others.push_back(i);
    ranking.best_first |= axes[i].is_text();
  }
  return ranking;
}

/// One line of the grid, as an experiment of its own.
struct Row {
  std::vector<double> others;
  LinkResult line;
};

/// The lines in the order in which the grid comes to them.
std::vector<Row> rows_of(const LinkResult& result, const Ranking& at) {
  std::vector<Row> rows;
  std::map<std::vector<double>, std::size_t> known;
  for (const LinkPoint& p : result.points) {
    std::vector<double> others;
    for (const std::size_t axis : at.others) others.push_back(p.coordinates[axis]);
    const auto [row, is_new] = known.try_emplace(others, rows.size());
    if (is_new) {
      rows.push_back({std::move(others), {}});
      rows.back().line.axes = {result.axes[at.abscissa]};
    }
    auto& points = rows[row->second].line.points;
    points.push_back(p);
    points.back().coordinates = {p.coordinates[at.abscissa]};
  }
  return rows;
}

std::uint64_t validity_flags_of(const LinkResult& line) {
  std::uint64_t all = 0;
  for (const LinkPoint& p : line.points) all |= p.validity_flags;
  return all;
}

double loss_at(const LinkResult& result, std::size_t axis, double coordinate) {
  double frames = 0, lost = 0;
  for (const LinkPoint& p : result.points) {
    if (p.coordinates[axis] != coordinate || p.tally.is_weighted()) continue;
    frames += static_cast<double>(p.tally.n_frames);
    lost += static_cast<double>(p.tally.n_frames_lost);
  }
  return frames > 0 ? lost / frames : 0;
}

bool more_is_better(const LinkResult& result, std::size_t abscissa) {
  const auto [low, high] = std::ranges::minmax(result.axes[abscissa].values);
  return loss_at(result, abscissa, low) > loss_at(result, abscissa, high);
}

double merit(const Crossing& c, bool more_better) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double almost = std::numeric_limits<double>::max();  // beyond all crossings
  switch (c.kind) {
    case Kind::all_below:
      return infinity;
    case Kind::all_above:
      return -almost;
    case Kind::unfinished:
      return -infinity;
    case Kind::fitted:
    case Kind::jump:
    case Kind::bracketed:
      return more_better ? -c.at : c.at;
    case Kind::unclear:
    case Kind::not_monotone:
      break;
  }
  return -almost / 2;
}

/// What a row is sorted by: values of the axes of numbers stand as in the grid, within each the
/// best comes first, and of equals one that no limit flags.
struct Standing {
  std::vector<std::size_t> group;  // of each axis of numbers which value, in the grid's order
  double merit;
  bool flagged;

  bool operator<(const Standing& o) const {
    return std::tie(group, o.merit, flagged) < std::tie(o.group, merit, o.flagged);
  }
  bool equals(const Standing& o) const { return group == o.group && merit == o.merit; }
};

Standing standing_of(const LinkResult& result, const Ranking& ranking, const RowCrossing& row) {
  Standing standing{{}, row.merit, row.validity_flags != 0};
  for (std::size_t i = 0; i < ranking.others.size(); ++i) {
    const Axis& axis = result.axes[ranking.others[i]];
    if (axis.is_text()) continue;
    const auto value = std::ranges::find(axis.values, row.others[i]);
    standing.group.push_back(static_cast<std::size_t>(value - axis.values.begin()));
  }
  return standing;
}

void sort_best_first(const LinkResult& result, Ranking& ranking) {
  const auto standing = [&](const RowCrossing& row) { return standing_of(result, ranking, row); };
  std::ranges::stable_sort(ranking.rows, std::less<>(), standing);
  std::size_t begin = 0;  // of the group
  for (std::size_t i = 0; i < ranking.rows.size(); ++i) {
    const Standing now = standing(ranking.rows[i]);
    if (standing(ranking.rows[begin]).group != now.group) begin = i;
    const bool tie = i > begin && standing(ranking.rows[i - 1]).equals(now);
    ranking.rows[i].place = tie ? ranking.rows[i - 1].place : i - begin + 1;
  }
  for (RowCrossing& row : ranking.rows)
    if (row.crossing.kind == Kind::unfinished) row.place = 0;
}

/// What the table marks at points of the row.
std::string mark(const RowCrossing& row) {
  return row.validity_flags == 0 ? "" : "! " + raised_names(validity_limits(), row.validity_flags);
}

/// A column of the list, as wide as the widest of its texts.
class ListColumn {
 public:
  explicit ListColumn(std::string name, bool to_the_left = true)
      : name_(std::move(name)), to_the_left_(to_the_left), width_(name_.size()) {}

  void add(std::string text) {
    is_empty_ = is_empty_ && text.empty();
    width_ = std::max(width_, text.size());
    texts_.push_back(std::move(text));
  }

  bool is_empty() const { return is_empty_; }
  std::string head() const { return cell(name_); }
  std::string row(std::size_t i) const { return cell(texts_[i]); }

 private:
  std::string cell(const std::string& text) const {
    return to_the_left_ ? fmt::format("  {:<{}}", text, width_)
                        : fmt::format("  {:>{}}", text, width_);
  }

  std::string name_;
  bool to_the_left_;
  std::size_t width_;
  bool is_empty_ = true;
  std::vector<std::string> texts_{};  // one a row
};

ListColumn axis_column(const LinkResult& result, const Ranking& ranking, std::size_t other) {
  const Axis& axis = result.axes[ranking.others[other]];
  const bool plain = axis.unit.empty() || axis.unit == "1";
  const std::string name = axis.key.substr(axis.key.rfind('.') + 1);
  ListColumn column{plain ? name : name + " [" + axis.unit + "]", axis.is_text()};
  for (const RowCrossing& row : ranking.rows) column.add(coordinate_text(axis, row.others[other]));
  return column;
}

/// Those that no row has anything in are left out.
std::vector<ListColumn> columns_of(const LinkResult& result, const Ranking& ranking) {
  const Axis& abscissa = result.axes[ranking.abscissa];
  std::vector<ListColumn> columns;
  for (std::size_t i = 0; i < ranking.others.size(); ++i)
    columns.push_back(axis_column(result, ranking, i));
  ListColumn crossing{"passes at"}, units{"8 of 10 units"}, note{""}, marks{""};
  for (const RowCrossing& row : ranking.rows) {
    crossing.add(crossing_words(abscissa, row.crossing, ranking.more_is_better));
    units.add(row.doubt ? span_words(abscissa, row.doubt->quantiles) : "");
    note.add(crossing_note(row.crossing, ranking.flr));
    marks.add(mark(row));
  }
  for (ListColumn& column : {std::ref(crossing), std::ref(units), std::ref(note), std::ref(marks)})
    if (!column.is_empty()) columns.push_back(std::move(column));
  return columns;
}

std::string without_end_blanks(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

std::string broken_rule_line(const RangeDoubt& doubt) {
  return fmt::format(
      "do not rely on it: {} was measured, and does not follow the rule of the model (cosys-sim "
      "fit)\n",
      doubt.part);
}

/// Below the only row.
std::string doubt_line(const Axis& axis, const RangeDoubt& doubt) {
  if (doubt.breaks_rule) return broken_rule_line(doubt);
  const std::string span = span_words(axis, doubt.quantiles);
  if (doubt.is_measured)
    return fmt::format(
        "as measured; {} in 8 of 10 cases, as not all of {} is told (--doubt says more)\n", span,
        doubt.part);
  return fmt::format(
      "as assumed; {} for 8 of 10 units, as not all of {} is known (--doubt says "
      "more; measure yours: cosys-sim fit)\n",
      span, doubt.part);
}

/// Of the parts of all rows that were found to break the rule, each once.
std::string broken_rule_lines(const Ranking& ranking) {
  std::set<std::string> lines;
  for (const RowCrossing& row : ranking.rows)
    if (row.doubt && row.doubt->breaks_rule) lines.insert(broken_rule_line(*row.doubt));
  return fmt::format("{}", fmt::join(lines, ""));
}

/// Below all rows: what their doubts mean.
std::string doubt_note(const Ranking& ranking) {
  std::vector<RangeDoubt> doubts;
  for (const RowCrossing& row : ranking.rows)
    if (row.doubt) doubts.push_back(*row.doubt);
  if (doubts.empty()) return "";
  const bool all_measured = std::ranges::all_of(doubts, &RangeDoubt::is_measured);
  return fmt::format(
      "as {}; 8 of 10 units: of {} drawn within what is not {} of a part (--doubt says "
      "more{})\n{}",
      all_measured ? "measured" : "assumed", doubts.front().units, all_measured ? "told" : "known",
      all_measured ? "" : "; measure yours: cosys-sim fit", broken_rule_lines(ranking));
}

std::string list(const LinkResult& result, const Ranking& ranking) {
  const Axis& abscissa = result.axes[ranking.abscissa];
  const std::vector<ListColumn> columns = columns_of(result, ranking);
  const auto place = [&](const std::string& text) {
    return ranking.best_first ? fmt::format("{:>4}", text) : std::string();
  };
  std::string text = fmt::format("{} at which frame loss passes {:g} %{}:\n", abscissa.key,
                                 ranking.flr * 100, ranking.best_first ? ", best first" : "");
  std::string head = place("");
  for (const ListColumn& column : columns) head += column.head();
  text += without_end_blanks(std::move(head));
  for (std::size_t i = 0; i < ranking.rows.size(); ++i) {
    const RowCrossing& row = ranking.rows[i];
    text += place(row.place == 0 ? "-" : std::to_string(row.place));
    std::string cells;
    for (const ListColumn& column : columns) cells += column.row(i);
    text += without_end_blanks(std::move(cells));
  }
  return text + doubt_note(ranking);
}

}  // namespace

std::optional<bool> known_direction(const std::string& key) {
  if (key == distance_key) return false;
  if (key == "led.current_ma" || key == "receiver.ebn0_db") return true;
  return std::nullopt;
}

std::size_t abscissa_of(const std::vector<Axis>& axes, const std::string& named) {
  std::size_t abscissa = Ranking::none;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i].key == (named.empty() ? distance_key : named)) return i;
    if (!axes[i].is_text() && axes[i].key != unit_key) abscissa = i;
  }
  return abscissa;
}

Ranking rank(const LinkResult& result, const CrossingQuestion& question) {
  Ranking ranking = axes_of(result.axes, question);
  if (ranking.abscissa == Ranking::none) return ranking;
  ranking.more_is_better = more_is_better(result, ranking.abscissa);
  for (Row& row : rows_of(result, ranking)) {
    if (is_weighted(row.line)) continue;  // fits are to counts
    const Crossing crossing = frame_loss_crossing(row.line, question.flr);
    ranking.rows.push_back({.others = std::move(row.others),
                            .crossing = crossing,
                            .validity_flags = validity_flags_of(row.line),
                            .merit = merit(crossing, ranking.more_is_better)});
  }
  if (ranking.best_first) sort_best_first(result, ranking);
  return ranking;
}

LinkResult best_first(const LinkResult& result, const Ranking& ranking) {
  if (!ranking.best_first || ranking.others.size() != 1) return result;
  const std::size_t named = ranking.others.front();
  const Axis& axis = result.axes[named];
  const bool are_all_ranked = ranking.rows.size() == axis.values.size();
  if (!are_all_ranked) return result;
  std::vector<std::size_t> from;  // which value stands at each place
  for (const RowCrossing& row : ranking.rows)
    from.push_back(static_cast<std::size_t>(row.others.front()));
  std::size_t stride = 1;  // from a value's points to the next value's
  for (std::size_t i = named + 1; i < result.axes.size(); ++i)
    stride *= result.axes[i].values.size();
  LinkResult sorted = result;
  for (std::size_t place = 0; place < from.size(); ++place)
    sorted.axes[named].labels[place] = axis.labels[from[place]];
  for (std::size_t i = 0; i < sorted.points.size(); ++i) {
    const std::size_t place = i / stride % from.size();
    sorted.points[i] = result.points[i - place * stride + from[place] * stride];
    sorted.points[i].coordinates[named] = axis.values[place];
  }
  return sorted;
}

std::string ranking_lines(const LinkResult& result, const Ranking& ranking) {
  if (ranking.rows.empty()) return "";
  if (!ranking.others.empty()) return list(result, ranking);
  const RowCrossing& row = ranking.rows.front();
  const Axis& abscissa = result.axes[ranking.abscissa];
  const bool is_reach = abscissa.key == distance_key && !ranking.more_is_better;
  const auto sentence = is_reach ? reach_sentence : crossing_sentence;
  const std::string marks = mark(row);
  return sentence(abscissa, row.crossing, ranking.flr) + (marks.empty() ? "" : "  " + marks) +
         "\n" + (row.doubt ? doubt_line(abscissa, *row.doubt) : "");
}

}  // namespace sim
