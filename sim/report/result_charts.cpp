#include "sim/report/result_charts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "sim/counting/statistics.hpp"

namespace sim {
namespace {

/// Axes that a picture can be drawn over, those with the most values first.
std::vector<std::size_t> widest_axes(const std::vector<Axis>& axes) {
  std::vector<std::size_t> widest;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (!axes[i].is_text() && axes[i].values.size() > 1) widest.push_back(i);
  std::ranges::stable_sort(widest, std::greater<>(),
                           [&](std::size_t i) { return axes[i].values.size(); });
  return widest;
}

/// Values of several decades crowd at one end of a linear axis.
bool spans_decades(const std::vector<double>& values) {
  constexpr double decades = 100;
  const auto [least, greatest] = std::ranges::minmax(values);
  return least > 0 && greatest / least >= decades;
}

ChartAxis chart_axis(const Axis& axis) { return {axis_name(axis), spans_decades(axis.values)}; }

/// What the point's other axes than these say: "receiver.module = TSOP4856".
std::string other_values(const std::vector<Axis>& axes, const std::vector<std::size_t>& over,
                         const PointResult& point) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (std::ranges::find(over, i) == over.end())
      parts.push_back(
          fmt::format("{} = {}", axes[i].key, coordinate_text(axes[i], point.coordinates[i])));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string curve_name(const std::vector<Axis>& axes, std::size_t over, const PointResult& point,
                       bool is_theory) {
  const std::string others = other_values(axes, {over}, point);
  if (others.empty()) return is_theory ? "theory" : "measured";
  return is_theory ? others + ", theory" : others;
}

ChartPoint chart_point(double x, const Estimate& estimate) {
  return {.x = x,
          .y = estimate.value,
          .low = estimate.low,
          .high = estimate.high,
          .is_limit = estimate.value == 0};
}

/// Points of one curve, found by its name, in the order of their first points.
ChartCurve& curve_of(std::vector<ChartCurve>& curves, const std::string& name, bool is_theory) {
  const auto found = std::ranges::find(curves, name, &ChartCurve::name);
  if (found != curves.end()) return *found;
  return curves.emplace_back(
      ChartCurve{name, {}, is_theory ? CurveKind::theory : CurveKind::measured});
}

struct Ratio {
  const char* title;
  const char* label;
  Estimate (*estimate)(const Tally&, double level);
  double OperatingPoint::*theory;  // null where there is none
};

constexpr Ratio ratios[] = {
    {"Bit errors", "bit error ratio (BER)", bit_error_ratio, &OperatingPoint::ber_theory},
    {"Frame loss", "frame loss ratio (FLR)", frame_loss_ratio, nullptr}};

Chart chart_of(const ExperimentResult& result, std::size_t over, const Ratio& ratio) {
  Chart chart{.title = ratio.title,
              .description = fmt::format("{} over {}, {:g} % intervals", ratio.label,
                                         result.axes[over].key, 100 * result.ci_level),
              .x = chart_axis(result.axes[over]),
              .y = {ratio.label, true},
              .curves = {}};
  for (const PointResult& point : result.points) {
    if (!measured(point)) continue;
    const double x = point.coordinates[over];
    const Estimate estimate = ratio.estimate(point.tally, result.ci_level);
    if (!std::isnan(estimate.value))
      curve_of(chart.curves, curve_name(result.axes, over, point, false), false)
          .points.push_back(chart_point(x, estimate));
    const double theory = ratio.theory == nullptr ? std::nan("") : point.operating.*ratio.theory;
    if (!std::isnan(theory))
      curve_of(chart.curves, curve_name(result.axes, over, point, true), true)
          .points.push_back({x, theory, theory, theory});
  }
  for (ChartCurve& curve : chart.curves) std::ranges::stable_sort(curve.points, {}, &ChartPoint::x);
  return chart;
}

std::vector<std::string> value_texts(const Axis& axis) {
  std::vector<std::string> texts;
  for (const double value : axis.values) texts.push_back(coordinate_text(axis, value));
  return texts;
}

std::size_t index_of(const Axis& axis, double value) {
  return static_cast<std::size_t>(std::ranges::find(axis.values, value) - axis.values.begin());
}

HeatMap empty_map(const ExperimentResult& result, std::size_t x, std::size_t y,
                  const std::string& others) {
  const Axis &across = result.axes[x], &up = result.axes[y];
  return {.title = "Map of frame loss" + (others.empty() ? others : ", " + others),
          .description = fmt::format("frame loss ratio over {} and {}", across.key, up.key),
          .x_label = axis_name(across),
          .y_label = axis_name(up),
          .columns = value_texts(across),
          .rows = value_texts(up),
          .values = {up.values.size(), std::vector<double>(across.values.size(), std::nan(""))}};
}

}  // namespace

std::string axis_name(const Axis& axis) {
  const bool has_unit = !axis.unit.empty() && axis.unit != "1";
  return has_unit ? fmt::format("{} [{}]", axis.key, axis.unit) : axis.key;
}

std::vector<Chart> result_charts(const ExperimentResult& result) {
  const std::vector<std::size_t> over = widest_axes(result.axes);
  std::vector<Chart> charts;
  if (over.empty()) return charts;
  for (const Ratio& ratio : ratios) {
    charts.push_back(chart_of(result, over.front(), ratio));
    if (charts.back().curves.empty()) charts.pop_back();
  }
  return charts;
}

std::vector<HeatMap> result_maps(const ExperimentResult& result) {
  const std::vector<std::size_t> over = widest_axes(result.axes);
  if (over.size() < 2) return {};
  std::map<std::string, HeatMap> maps;
  for (const PointResult& point : result.points) {
    const std::string others = other_values(result.axes, {over[0], over[1]}, point);
    const auto [map, is_new] = maps.try_emplace(others);
    if (is_new) map->second = empty_map(result, over[0], over[1], others);
    map->second.values[index_of(result.axes[over[1]], point.coordinates[over[1]])]
                      [index_of(result.axes[over[0]], point.coordinates[over[0]])] =
        frame_loss_ratio(point.tally, result.ci_level).value;
  }
  std::vector<HeatMap> all;
  for (auto& [others, map] : maps) all.push_back(std::move(map));
  return all;
}

}  // namespace sim
