#pragma once
// Curves over a sweep: which axis they are drawn over, and what tells them apart.
#include <string>
#include <vector>

#include "sim/picture/chart.hpp"
#include "sim/scenario/axis.hpp"

namespace sim {

/// "receiver.range_m [m]": what is written along an axis.
std::string axis_name(const Axis& axis);

/// Axes of more than one number, those with the most values first.
std::vector<std::size_t> widest_axes(const std::vector<Axis>& axes);

/// Logarithmic where the values grow by factors, as they would crowd at one end.
ChartAxis chart_axis(const Axis& axis);

/// What the coordinates on the axes other than `over` are: "receiver.module = TSOP4856".
std::string other_values(const std::vector<Axis>& axes, const std::vector<std::size_t>& over,
                         const std::vector<double>& coordinates);

/// The curve of that name, which is added where there is none.
ChartCurve& curve_of(Chart& chart, const std::string& name, CurveKind kind);

/// The theory of one of the chart's curves, behind it; which is added where there is none.
ChartCurve& theory_of(Chart& chart, const ChartCurve& curve, const std::string& name);

/// Each curve's points from left to right. Curves of none are taken out, but for those whose
/// theory, which has their colour, stands behind them.
void settle(Chart& chart);

}  // namespace sim
