#include "sim/link_experiment/link_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "sim/columns/estimate_text.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/result/point_loss.hpp"
#include "sim/result/ranking.hpp"
#include "sim/result/unit_spread.hpp"
#include "sim/section/swept_curves.hpp"
#include "sim/section/swept_maps.hpp"

namespace sim {
namespace {

std::string curve_name(const std::vector<Axis>& axes, std::size_t over, const LinkPoint& point,
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
  Estimate (*estimate)(const LinkPoint&, double level);
  double OperatingPoint::*theory;  // null where there is none
};

Estimate bit_errors_of(const LinkPoint& point, double level) {
  return bit_error_ratio(point.tally, level);
}

constexpr Ratio ratios[] = {
    {"Frame loss", "frame loss ratio (FLR)", 0.01, frame_loss_of, nullptr},
    {"Bit errors", "bit error ratio (BER)", {}, bit_errors_of, &OperatingPoint::ber_theory}};

Chart chart_of(const LinkResult& result, std::size_t over, const Ratio& ratio) {
  Chart chart{.title = ratio.title,
              .description = fmt::format("{} over {}, {:g} % intervals", ratio.label,
                                         result.axes[over].key, 100 * LinkResult::ci_level),
              .x = chart_axis(result.axes[over]),
              .y = {.label = ratio.label, .logarithmic = true, .level = ratio.level},
              .curves = {}};
  for (const LinkPoint& point : result.points) {
    if (!point.reached()) continue;
    const double x = point.coordinates[over];
    const Estimate estimate = ratio.estimate(point, LinkResult::ci_level);
    ChartCurve& curve =
        curve_of(chart, curve_name(result.axes, over, point, false), CurveKind::measured);
    if (!std::isnan(estimate.value)) curve.points.push_back(chart_point(x, estimate));
    const double theory = ratio.theory == nullptr ? std::nan("") : point.operating.*ratio.theory;
    if (!std::isnan(theory))
      theory_of(chart, curve, curve_name(result.axes, over, point, true))
          .points.push_back({x, theory, theory, theory});
  }
  settle(chart);
  return chart;
}

ChartPoint share_point(double x, const UnitShare& share) {
  const auto carried = static_cast<double>(share.carried), units = static_cast<double>(share.units);
  const Interval interval = clopper_pearson(carried, units, LinkResult::ci_level);
  return {.x = x, .y = carried / units, .low = interval.low, .high = interval.high};
}

/// In place of a curve for each unit.
Chart units_chart(const UnitSpread& spread, std::size_t over) {
  const std::string losing = fmt::format("lose at most {:g} %", 100 * spread.flr);
  Chart chart{.title = "Share of units that carry",
              .description = fmt::format("Share of units that {} over {}, {:g} % intervals", losing,
                                         spread.axes[over].key, 100 * LinkResult::ci_level),
              .x = chart_axis(spread.axes[over]),
              .y = {.label = "share of units that " + losing, .from_zero = true},
              .curves = {}};
  for (const UnitShare& share : spread.shares) {
    if (share.units == 0) continue;
    const std::string others = other_values(spread.axes, {over}, share.coordinates);
    curve_of(chart, others.empty() ? "units" : others, CurveKind::measured)
        .points.push_back(share_point(share.coordinates[over], share));
  }
  settle(chart);
  return chart;
}

/// The axis of which the answer speaks, if it has more than one value.
std::optional<std::size_t> drawn_over(const std::vector<Axis>& axes) {
  const std::size_t abscissa = abscissa_of(axes);
  if (abscissa != Ranking::none && axes[abscissa].values.size() > 1) return abscissa;
  const std::vector<std::size_t> widest = widest_axes(axes);
  return widest.empty() ? std::nullopt : std::optional(widest.front());
}

}  // namespace

std::vector<Chart> result_charts(const LinkResult& result) {
  const auto spread = unit_spread(result);
  const std::optional<std::size_t> over = drawn_over(spread ? spread->axes : result.axes);
  std::vector<Chart> charts;
  if (!over) return charts;
  if (spread)
    charts.push_back(units_chart(*spread, *over));
  else
    for (const Ratio& ratio : ratios) charts.push_back(chart_of(result, *over, ratio));
  std::erase_if(charts, [](const Chart& chart) { return chart.curves.empty(); });
  return charts;
}

std::vector<HeatMap> result_maps(const LinkResult& result) {
  std::vector<MapValue> losses;
  for (const LinkPoint& point : result.points) {
    const Estimate loss = frame_loss_of(point, LinkResult::ci_level);
    losses.push_back({loss.value, estimate_text(loss)});
  }
  return swept_maps(result.axes, losses, "Map of frame loss", "frame loss ratio");
}

}  // namespace sim
