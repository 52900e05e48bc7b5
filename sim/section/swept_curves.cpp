#include "sim/section/swept_curves.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "sim/scenario/keys.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

/// How much the greatest of the steps between neighbours is of the least.
double unevenness(const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(values[i] - values[i - 1]);
  const auto [least, greatest] = std::ranges::minmax(steps);
  return greatest / least;
}

/// Different values in order, as curves have them.
std::vector<double> in_order(std::vector<double> values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// Whether they would crowd at one end of a linear axis: where they span two decades; or are three
/// at least, go up by factors rather than by steps, and span a decade or have much the same factor.
bool grow_by_factors(const std::vector<double>& all) {
  constexpr double two_decades = 100, decade = 10, twice_double = 4, much_the_same = 1.5;
  const std::vector<double> values = in_order(all);
  if (values.size() < 2 || values.front() <= 0) return false;
  const double span = values.back() / values.front();
  if (span >= two_decades || values.size() < 3) return span >= two_decades;
  std::vector<double> logarithms;
  for (const double value : values) logarithms.push_back(std::log(value));
  const double of_factors = unevenness(logarithms);
  return of_factors < unevenness(values) &&
         (span >= decade || (span >= twice_double && of_factors <= much_the_same));
}

}  // namespace

std::string axis_name(const Axis& axis) {
  const std::string unit = bracketed_unit(axis.unit);
  return unit.empty() ? axis.key : axis.key + " " + unit;
}

std::vector<std::size_t> widest_axes(const std::vector<Axis>& axes) {
  std::vector<std::size_t> widest;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (!axes[i].is_text() && axes[i].values.size() > 1) widest.push_back(i);
  std::ranges::stable_sort(widest, std::greater<>(),
                           [&](std::size_t i) { return axes[i].values.size(); });
  return widest;
}

ChartAxis chart_axis(const Axis& axis) {
  const Key* key = find_key(axis.key);
  return {.label = axis_name(axis),
          .logarithmic = grow_by_factors(axis.values),
          .words = axis.long_name,
          .is_count = key != nullptr && key->facts.type == KeyType::whole_number};
}

std::string other_values(const std::vector<Axis>& axes, const std::vector<std::size_t>& over,
                         const std::vector<double>& coordinates) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (std::ranges::find(over, i) == over.end()) {
      const std::string value = coordinate_text(axes[i], coordinates[i]);
      parts.push_back(axes[i].is_text() ? value : axes[i].key + " = " + value);
    }
  return fmt::format("{}", fmt::join(parts, ", "));
}

ChartCurve& curve_of(Chart& chart, const std::string& name, CurveKind kind) {
  const auto found = std::ranges::find(chart.curves, name, &ChartCurve::name);
  if (found != chart.curves.end()) return *found;
  return chart.curves.emplace_back(ChartCurve{name, {}, kind});
}

ChartCurve& theory_of(Chart& chart, const ChartCurve& curve, const std::string& name) {
  const auto behind = chart.curves.begin() + (&curve - chart.curves.data()) + 1;
  if (behind != chart.curves.end() && behind->kind == CurveKind::theory) return *behind;
  return *chart.curves.insert(behind, {name, {}, CurveKind::theory});
}

void settle(Chart& chart) {
  std::vector<ChartCurve>& curves = chart.curves;
  for (ChartCurve& curve : curves) std::ranges::stable_sort(curve.points, {}, &ChartPoint::x);
  for (std::size_t i = curves.size(); i-- > 0;) {
    const bool has_theory = i + 1 < curves.size() && curves[i + 1].kind == CurveKind::theory;
    if (curves[i].points.empty() && !has_theory)
      curves.erase(curves.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace sim
