#include "sim/section/picture_sections.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <utility>

#include "sim/columns/estimate_text.hpp"

namespace sim {
namespace {

bool has_interval(const ChartCurve& curve, const ChartPoint& point) {
  const bool may = curve.kind == CurveKind::measured || curve.kind == CurveKind::bars;
  return may && point.low != point.high;
}

/// Counts as they are.
std::string value_text(double value) {
  constexpr double exact = 1e15;
  return value == std::round(value) && std::abs(value) < exact ? fmt::format("{:.0f}", value)
                                                               : fmt::format("{:.3g}", value);
}

/// The name of a lone curve would say nothing.
PageTable pictured_table(const Chart& chart) {
  const bool are_several = chart.curves.size() > 1;
  PageTable table{.head = {chart.x.label, chart.y.label}, .rows = {}};
  if (are_several) table.head.insert(table.head.begin(), "curve");
  for (const ChartCurve& curve : chart.curves)
    for (const ChartPoint& point : curve.points) {
      table.rows.push_back(
          {fmt::format("{:.6g}", point.x), has_interval(curve, point)
                                               ? estimate_text({point.y, point.low, point.high})
                                               : value_text(point.y)});
      if (are_several) table.rows.back().insert(table.rows.back().begin(), curve.name);
    }
  return table;
}

/// From above, as the picture has it.
PageTable pictured_table(const HeatMap& map) {
  PageTable table{.head = {map.y_label + " \\ " + map.x_label}, .rows = {}};
  table.head.insert(table.head.end(), map.columns.begin(), map.columns.end());
  for (std::size_t r = map.rows.size(); r-- > 0;) {
    table.rows.push_back({map.rows[r]});
    if (!map.texts.empty())
      table.rows.back().insert(table.rows.back().end(), map.texts[r].begin(), map.texts[r].end());
    else
      for (const double value : map.values[r])
        table.rows.back().push_back(std::isnan(value) ? "-" : fmt::format("{:.2g}", value));
  }
  return table;
}

std::string percent_of(std::uint64_t count, const std::vector<std::uint64_t>& counts) {
  const auto whole = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  if (whole == 0) return "-";
  return fmt::format("{:.1f}", 100 * static_cast<double>(count) / static_cast<double>(whole));
}

PageTable pictured_table(const ShareBars& bars) {
  PageTable table{.head = {bars.rows_label}, .rows = {}};
  for (const std::string& kind : bars.kinds)
    table.head.push_back(bars.are_shares ? kind + " [%]" : kind);
  for (const ShareRow& row : bars.rows) {
    table.rows.push_back({row.label});
    for (const std::uint64_t count : row.counts)
      table.rows.back().push_back(bars.are_shares ? percent_of(count, row.counts)
                                                  : std::to_string(count));
  }
  return table;
}

}  // namespace

PageSection chart_section(Chart chart) {
  std::string heading = chart.title;
  PageTable table = pictured_table(chart);
  return {.heading = std::move(heading),
          .picture = picture_of(std::move(chart)),
          .table = std::move(table)};
}

PageSection map_section(const std::string& name, const HeatMap& map) {
  return {.heading = map.title,
          .picture = PagePicture{name, map.description, heat_map_as_svg(map)},
          .table = pictured_table(map)};
}

PageSection shares_section(const std::string& name, const ShareBars& bars) {
  return {.heading = bars.title,
          .picture = PagePicture{name, bars.description, share_bars_as_svg(bars)},
          .table = pictured_table(bars)};
}

PageSection scenario_section(const std::string& command, const std::string& scenario_toml) {
  return {.heading = "The scenario",
          .text = "To repeat it: " + command +
                  "\nHere is all that ran, with what the command changed and with the parts of "
                  "other files: saved as a file, and run, it counts the same.",
          .preformatted = scenario_toml};
}

}  // namespace sim
