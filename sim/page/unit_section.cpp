#include "sim/page/unit_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "sim/counting/sample_quantile.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/picture/range_bars.hpp"
#include "sim/result/place_text.hpp"
#include "sim/section/swept_curves.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

constexpr std::size_t most_bars = 8;

/// In three digits: "55300".
std::string number(double value) {
  return fmt::format("{:g}", std::stod(fmt::format("{:.3g}", value)));
}

/// ">= 10" at an end of the sweep: what is there is not known to end there.
std::string range_number(const Axis& axis, double range) {
  const auto [least, most] = std::ranges::minmax(axis.values);
  if (range >= most) return ">= " + number(most);
  return (range <= least ? "<= " : "") + number(std::max(range, least));
}

std::string percent_text(const UnitShare& share) {
  if (share.units == 0) return "-";
  const Interval interval =
      clopper_pearson(static_cast<double>(share.carried), static_cast<double>(share.units), 0.95);
  return fmt::format("{:.0f} % [{:.0f}, {:.0f}]",
                     100.0 * static_cast<double>(share.carried) / static_cast<double>(share.units),
                     100 * interval.low, 100 * interval.high);
}

RangeBars effects_bars(const UnitSpread& spread, const std::vector<NumberEffect>& effects) {
  const Axis& axis = spread.axes[*spread.abscissa];
  RangeBars bars{.title = "What nobody printed, and the range",
                 .description =
                     "Median range of the third of the units where a number is lowest, "
                     "and of the third where it is highest",
                 .axis = axis_name(axis),
                 .middle = sample_quantile(middles_of(axis, spread.rows.front()), 0.5),
                 .bars = {}};
  for (const NumberEffect& e : effects)
    if (bars.bars.size() < most_bars)
      bars.bars.push_back({e.key, e.range_at_low, e.range_at_high, number(e.low),
                           with_unit(number(e.high), e.unit)});
  return bars;
}

PageTable effects_table(const Axis& axis, const std::vector<NumberEffect>& effects) {
  const std::string there = with_unit("range there", bracketed_unit(axis.unit));
  PageTable table{
      .head = {"number", "where it is low", there, "where it is high", there, "rank correlation"},
      .rows = {}};
  for (const NumberEffect& e : effects)
    table.rows.push_back({e.key, with_unit(number(e.low), e.unit),
                          range_number(axis, e.range_at_low), with_unit(number(e.high), e.unit),
                          range_number(axis, e.range_at_high),
                          fmt::format("{:+.2f}", e.correlation)});
  return table;
}

/// "At receiver.module = TSOP4856, the first of the sweep. ": of which row the effects are.
std::string first_place(const UnitSpread& spread) {
  const std::string place = place_text(axes_of_rows(spread), spread.rows.front().others);
  if (place.empty()) return "";
  return "At " + place + (spread.rows.size() > 1 ? ", the first of the sweep. " : ". ");
}

}  // namespace

PageSection units_section(const UnitSpread& spread) {
  PageTable table{.head = {}, .rows = {}, .is_answer = true};
  for (const Axis& axis : spread.axes) table.head.push_back(axis_name(axis));
  table.head.emplace_back("units");
  table.head.push_back(fmt::format("lose at most {:g} %", 100 * spread.flr));
  for (const UnitShare& share : spread.shares) {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < spread.axes.size(); ++i)
      cells.push_back(coordinate_text(spread.axes[i], share.coordinates[i]));
    cells.push_back(std::to_string(share.units));
    cells.push_back(percent_text(share));
    table.rows.push_back(std::move(cells));
  }
  return {.heading = "How many units carry",
          .text =
              "Each unit is a part whose numbers that nobody printed are drawn within their "
              "bounds, and its centre and threshold within theirs.",
          .table = std::move(table)};
}

PageSection effects_section(const UnitSpread& spread, const std::vector<NumberEffect>& effects) {
  const RangeBars bars = effects_bars(spread, effects);
  return {.heading = bars.title,
          .text = first_place(spread) +
                  "The strongest is on top. A bar goes from the median range to that of the third "
                  "of the units where the number is lowest, and where it is highest. Numbers whose "
                  "effect these units do not tell from none, at 95 %, are left out.",
          .picture = PagePicture{"unknown-numbers", bars.title, range_bars_as_svg(bars)},
          .table = effects_table(spread.axes[*spread.abscissa], effects)};
}

}  // namespace sim
