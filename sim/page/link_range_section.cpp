#include "sim/page/link_range_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "sim/columns/validity_column.hpp"
#include "sim/link/validity.hpp"
#include "sim/link_experiment/answer_text.hpp"
#include "sim/page/link_range.hpp"
#include "sim/page/numbers_section.hpp"
#include "sim/picture/reach_bars.hpp"
#include "sim/result/crossing_text.hpp"
#include "sim/result/place_text.hpp"
#include "sim/scenario/flags.hpp"
#include "sim/section/swept_curves.hpp"

namespace sim {
namespace {

bool has_doubts(const Ranking& ranking) {
  return std::ranges::any_of(ranking.rows,
                             [](const RowCrossing& row) { return row.doubt.has_value(); });
}

std::vector<std::string> reach_head(const LinkResult& result, const Ranking& ranking) {
  std::vector<std::string> head;
  if (ranking.best_first) head.emplace_back("place");
  for (const std::size_t axis : ranking.others) head.push_back(axis_name(result.axes[axis]));
  head.push_back(fmt::format("{} at which frame loss passes {:g} %",
                             result.axes[ranking.abscissa].key, 100 * ranking.flr));
  if (has_doubts(ranking)) head.emplace_back("8 of 10 units");
  return head;
}

std::string crossing_of(const LinkResult& result, const Ranking& ranking, const RowCrossing& row) {
  const std::string words =
      crossing_words(result.axes[ranking.abscissa], row.crossing, ranking.more_is_better);
  const std::string note = crossing_note(row.crossing, ranking.flr);
  return note.empty() ? words : words + ", " + note;
}

/// In a sentence.
std::string reach_words(const LinkResult& result, const Ranking& ranking, const RowCrossing& row) {
  std::string words = crossing_of(result, ranking, row);
  if (row.validity_flags == 0) return words;
  return fmt::format("{}, {}: {}", words, validity_words,
                     raised_names(validity_limits(), row.validity_flags));
}

/// In a table, with its mark.
std::string reach_text(const LinkResult& result, const Ranking& ranking, const RowCrossing& row) {
  std::string words = crossing_of(result, ranking, row);
  if (row.validity_flags == 0) return words;
  return words + "  " + raised_mark(validity_limits(), row.validity_flags, validity_sign);
}

/// Where most units end.
std::string doubt_of(const LinkResult& result, const Ranking& ranking, const RowCrossing& row) {
  return row.doubt ? span_words(result.axes[ranking.abscissa], row.doubt->quantiles) : "-";
}

/// What the grey of the bars means, and the column of units.
std::string doubts_text(const Ranking& ranking) {
  if (!has_doubts(ranking)) return "";
  return "Ranges are those of the parts as assumed. Not all of them is known: 8 of 10 units, "
         "each with what nobody printed drawn within its bounds, end within the grey of its bar. A "
         "run with --doubt says more; cosys-sim fit measures yours.";
}

std::string heading_of(const LinkResult& result, const Ranking& ranking) {
  return link_range_heading(result.axes[ranking.abscissa].key, ranking.rows.size());
}

/// Where a bar ends, and its interval; nothing of what is not told.
void set_reach(ReachBar& bar, const Crossing& c, bool more_is_better) {
  using Kind = Crossing::Kind;
  const bool is_beyond = c.kind == (more_is_better ? Kind::all_above : Kind::all_below);
  bar.at = bar.low = bar.high = is_beyond ? HUGE_VAL : -HUGE_VAL;
  if (c.kind != Kind::fitted && c.kind != Kind::jump && c.kind != Kind::bracketed) return;
  bar.at = c.at;
  bar.low = c.low;
  bar.high = c.high;
}

ReachBars bars_of(const LinkResult& result, const Ranking& ranking) {
  const Axis& along = result.axes[ranking.abscissa];
  const auto [least, most] = std::ranges::minmax(along.values);
  ReachBars bars{.title = heading_of(result, ranking),
                 .description = fmt::format("Where frame loss passes {:g} % along {}, a bar a link",
                                            100 * ranking.flr, along.key),
                 .axis = axis_name(along),
                 .from = along.key == distance_key ? 0 : least,
                 .to = most,
                 .bars = {}};
  for (const RowCrossing& row : ranking.rows) {
    const bool is_only = ranking.rows.size() == 1 && row.doubt;
    ReachBar bar{is_only ? row.doubt->part : link_words(result, ranking, row),
                 short_crossing_words(along, row.crossing, ranking.more_is_better)};
    set_reach(bar, row.crossing, ranking.more_is_better);
    if (row.doubt) {
      const UnitRange span = span_of(row.doubt->quantiles);
      bar.units = {span.low, span.high};
    }
    bars.bars.push_back(std::move(bar));
  }
  return bars;
}

/// Of so many that each is seen.
std::optional<PagePicture> reach_picture(const LinkResult& result, const Ranking& ranking) {
  constexpr std::size_t most_bars = 40;
  if (ranking.rows.size() > most_bars) return std::nullopt;
  const ReachBars bars = bars_of(result, ranking);
  if (bars.to <= bars.from) return std::nullopt;
  return PagePicture{picture_name(bars.title), bars.description, reach_bars_as_svg(bars)};
}

std::string link_of(const LinkResult& result, const Ranking& ranking, const RowCrossing& row) {
  std::vector<Axis> axes;
  for (const std::size_t axis : ranking.others) axes.push_back(result.axes[axis]);
  return place_text(axes, row.others);
}

}  // namespace

std::vector<LinkRange> link_ranges_of(const LinkResult& result, const Ranking& ranking) {
  std::vector<LinkRange> ranges;
  for (const RowCrossing& row : ranking.rows)
    ranges.push_back({result.axes[ranking.abscissa].key, link_of(result, ranking, row),
                      reach_words(result, ranking, row), row.merit,
                      row.crossing.kind != Crossing::Kind::unfinished});
  return ranges;
}

PageSection link_range_section(const LinkResult& result, const Ranking& ranking) {
  PageTable table{.head = reach_head(result, ranking), .rows = {}, .is_answer = true};
  for (const RowCrossing& row : ranking.rows) {
    std::vector<std::string> cells;
    if (ranking.best_first) cells.push_back(row.place == 0 ? "-" : std::to_string(row.place));
    for (std::size_t i = 0; i < ranking.others.size(); ++i)
      cells.push_back(coordinate_text(result.axes[ranking.others[i]], row.others[i]));
    cells.push_back(reach_text(result, ranking, row));
    if (has_doubts(ranking)) cells.push_back(doubt_of(result, ranking, row));
    table.rows.push_back(std::move(cells));
  }
  return {.heading = heading_of(result, ranking),
          .text = doubts_text(ranking),
          .picture = reach_picture(result, ranking),
          .table = std::move(table)};
}

}  // namespace sim
