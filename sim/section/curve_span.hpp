#pragma once
// Where along a sweep a curve is high enough, or too high: the longest stretch of its points.
#include <optional>
#include <string>

#include "sim/picture/chart.hpp"
#include "sim/scenario/axis.hpp"

namespace sim {

/// From the first of its points to the last. Where it reaches an end of the sweep, it may go on
/// beyond.
struct CurveSpan {
  std::string curve;  // its name
  double from = 0, to = 0;
  bool is_at_first = false, is_at_last = false;
  double length() const { return to - from; }
};

/// The longest stretch at which a curve, whose points are in order, is at `least` or more.
std::optional<CurveSpan> longest_span(const ChartCurve& curve, double least);

/// "receiver.range_m from 2 to 13 m, where the sweep ends (base)"
std::string in_words(const CurveSpan& span, const Axis& x);

}  // namespace sim
