#include "sim/report/result_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "sim/counting/statistics.hpp"
#include "sim/report/estimate_text.hpp"
#include "sim/report/swept_curves.hpp"
#include "sim/report/swept_maps.hpp"

namespace sim {
namespace {

std::string curve_name(const std::vector<Axis>& axes, std::size_t over, const PointResult& point,
                       bool is_theory) {
  const std::string others = other_values(axes, {over}, point.coordinates);
  if (others.empty()) return is_theory ? "theory" : "simulated";
  return is_theory ? others + ", theory" : others;
}

ChartPoint chart_point(double x, const Estimate& estimate) {
  return {.x = x,
          .y = estimate.value,
          .low = estimate.low,
          .high = estimate.high,
          .is_limit = estimate.value == 0};
}

struct Ratio {
  const char* title;
  const char* label;
  std::optional<double> level;
  Estimate (*estimate)(const Tally&, double level);
  double OperatingPoint::*theory;  // null where there is none
};

constexpr Ratio ratios[] = {
    {"Bit errors", "bit error ratio (BER)", {}, bit_error_ratio, &OperatingPoint::ber_theory},
    {"Frame loss", "frame loss ratio (FLR)", 0.01, frame_loss_ratio, nullptr}};

Chart chart_of(const ExperimentResult& result, std::size_t over, const Ratio& ratio) {
  Chart chart{.title = ratio.title,
              .description = fmt::format("{} over {}, {:g} % intervals", ratio.label,
                                         result.axes[over].key, 100 * result.ci_level),
              .x = chart_axis(result.axes[over]),
              .y = {.label = ratio.label, .logarithmic = true, .level = ratio.level},
              .curves = {}};
  for (const PointResult& point : result.points) {
    if (!measured(point)) continue;
    const double x = point.coordinates[over];
    const Estimate estimate = ratio.estimate(point.tally, result.ci_level);
    ChartCurve& curve =
        curve_of(chart, curve_name(result.axes, over, point, false), CurveKind::measured);
    if (!std::isnan(estimate.value)) curve.points.push_back(chart_point(x, estimate));
    const double theory = ratio.theory == nullptr ? std::nan("") : point.operating.*ratio.theory;
    if (!std::isnan(theory))
      curve_of(chart, curve_name(result.axes, over, point, true), CurveKind::theory)
          .points.push_back({x, theory, theory, theory});
  }
  settle(chart);
  return chart;
}

}  // namespace

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
  std::vector<MapValue> losses;
  for (const PointResult& point : result.points) {
    const Estimate loss = frame_loss_ratio(point.tally, result.ci_level);
    losses.push_back({loss.value, estimate_text(loss)});
  }
  return swept_maps(result.axes, losses, "Map of frame loss", "frame loss ratio");
}

}  // namespace sim
