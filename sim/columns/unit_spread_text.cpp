#include "sim/columns/unit_spread_text.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "sim/columns/text_table.hpp"
#include "sim/result/crossing_text.hpp"
#include "sim/result/place_text.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

std::string share_table(const UnitSpread& spread) {
  std::vector<TextColumn> columns = axis_columns(spread.axes);
  columns.push_back({{"", "units", ""}, 6});
  columns.push_back(
      {{"lose at", "most", with_unit(fmt::format("{:g}", 100 * spread.flr), "%")}, 8});
  std::vector<std::vector<std::string>> rows;
  for (const UnitShare& share : spread.shares) {
    std::vector<std::string> row = coordinate_texts(spread.axes, share.coordinates);
    row.push_back(std::to_string(share.units));
    row.push_back(share.units == 0 ? "-" : std::to_string(share.carried));
    rows.push_back(std::move(row));
  }
  return text_table(std::move(columns), rows);
}

std::string range_line(const UnitSpread& spread, const RangeSpread& row) {
  const Axis& axis = spread.axes[*spread.abscissa];
  const std::string place = place_text(axes_of_rows(spread), row.others);
  return fmt::format(
      "{}frame loss passes {:g} % at {} {} (10 % quantile of {} units), {} (median), {} (90 % "
      "quantile)\n",
      place.empty() ? "" : place + ": ", 100 * spread.flr, axis.key,
      range_words(axis, row.quantiles[0]), row.units.size(), range_words(axis, row.quantiles[1]),
      range_words(axis, row.quantiles[2]));
}

}  // namespace

std::string unit_spread_lines(const Dataset& data) {
  const auto spread = unit_spread(data);
  if (!spread) return "";
  std::string lines =
      "units drawn within what nobody printed of their part:\n" + share_table(*spread);
  return lines + range_lines(*spread);
}

std::string range_lines(const UnitSpread& spread) {
  std::string lines;
  for (const RangeSpread& row : spread.rows) lines += range_line(spread, row);
  return lines;
}

}  // namespace sim
