#include "sim/section/dataset_charts.hpp"

#include <fmt/format.h>

#include <cmath>

#include "sim/result/place_text.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/section/swept_curves.hpp"

namespace sim {
namespace {

/// The cells of a variable with its interval; those of what a dataset does not have are empty.
struct DrawnCells {
  std::vector<double> values, lows, highs, theory;

  DrawnCells(const Dataset& data, const DrawnVariable& drawn)
      : values(numbers_named(data, drawn.name)),
        lows(numbers_named(data, drawn.name + "_ci_low")),
        highs(numbers_named(data, drawn.name + "_ci_high")),
        theory(numbers_named(data, drawn.how.theory)) {}

  bool has_interval(std::size_t i) const {
    return i < lows.size() && i < highs.size() && std::isfinite(lows[i]) && std::isfinite(highs[i]);
  }

  /// Of what a linear axis shows, nothing found is a point at 0.
  ChartPoint point(double x, std::size_t i, bool logarithmic) const {
    const double y = values[i];
    if (!has_interval(i)) return {x, y, y, y};
    return {.x = x,
            .y = y,
            .low = lows[i],
            .high = highs[i],
            .is_limit = logarithmic && y == 0 && highs[i] > 0};
  }

  /// Adds a cell to the curve of that name, and to its theory.
  void add_to(Chart& chart, const std::string& name, double x, std::size_t i) const {
    ChartCurve& measured = curve_of(chart, name.empty() ? "simulated" : name, CurveKind::measured);
    if (std::isfinite(values[i])) measured.points.push_back(point(x, i, chart.y.logarithmic));
    if (i < theory.size() && std::isfinite(theory[i]))
      theory_of(chart, measured, joined(name, "theory"))
          .points.push_back({x, theory[i], theory[i], theory[i]});
  }
};

Chart empty_chart(const DrawnVariable& drawn, const ChartAxis& x) {
  return {.title = drawn.how.title,
          .description = fmt::format("{} over {}", drawn.how.label, x.label),
          .x = x,
          .y = {drawn.how.label, drawn.how.logarithmic},
          .curves = {}};
}

}  // namespace

const Axis* widest_axis(const Dataset& data) {
  const std::vector<std::size_t> widest = widest_axes(data.axes);
  return widest.empty() ? nullptr : &data.axes[widest.front()];
}

std::optional<Chart> swept_chart(const Dataset& data, const DrawnVariable& drawn) {
  const Dataset::Variable* variable = find_variable(data, drawn.name);
  const std::vector<std::size_t> widest = widest_axes(data.axes);
  if (variable == nullptr || !variable->on_axes || widest.empty()) return std::nullopt;
  const std::size_t over = widest.front();
  const DrawnCells cells(data, drawn);
  const std::vector<std::string> elements = element_texts(data, *variable);
  Chart chart = empty_chart(drawn, chart_axis(data.axes[over]));
  for (std::size_t i = 0; i < cells.values.size(); ++i) {
    const std::vector<double> at = point_coordinates(data.axes, i / elements.size());
    cells.add_to(chart, joined(other_values(data.axes, {over}, at), elements[i % elements.size()]),
                 at[over], i);
  }
  settle(chart);
  return chart;
}

std::optional<Chart> dimension_chart(const Dataset& data, const DrawnVariable& drawn) {
  const Dataset::Variable* variable = find_variable(data, drawn.name);
  if (variable == nullptr || variable->dimensions.size() != 1) return std::nullopt;
  const Dataset::Dimension& dimension = dimension_named(data, variable->dimensions.front());
  const auto* places = std::get_if<std::vector<double>>(&dimension.values);
  if (places == nullptr || places->empty()) return std::nullopt;
  const DrawnCells cells(data, drawn);
  Chart chart = empty_chart(
      drawn, chart_axis({dimension.facts.long_name, dimension.facts.unit, "", *places}));
  for (std::size_t i = 0; i < cells.values.size(); ++i)
    cells.add_to(chart,
                 other_values(data.axes, {}, point_coordinates(data.axes, i / places->size())),
                 (*places)[i % places->size()], i);
  settle(chart);
  return chart;
}

}  // namespace sim
