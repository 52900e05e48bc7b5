#pragma once
// Where the name of a curve stands beside it, so that nobody has to look into a legend.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sim/picture/svg.hpp"

namespace sim {

/// A line on paper from one point to another, which may be the same.
struct PaperLine {
  SvgPoint from, to;
};

/// A curve as it lies on paper, in pixels.
struct LaidCurve {
  std::string name;                             // empty: it wants none
  std::vector<std::optional<SvgPoint>> points;  // nothing: it is broken there
  std::vector<PaperLine> intervals;             // are kept clear too
  bool is_theory = false;                       // of another one, whose name may stand near it
};

/// A rectangle of the paper, in pixels; y grows downward.
struct PaperBox {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// The name of a curve stands beside the line from one of its points to the next.
struct CurveLabel {
  std::size_t curve = 0;  // its place in the list
  std::size_t point = 0;
  double along = 0;  // so much of the way to the next point, from 0 to 1
  bool is_left = false, is_above = false;

  bool operator==(const CurveLabel&) const = default;
};

/// Where the words begin, or end where the label is left of the line: on their lower edge.
SvgPoint anchor_of(const CurveLabel& label, const LaidCurve& curve);

/// Each name where its curve is well apart from the others, within the paper, over no curve and no
/// other name, and nearer to its own curve than to another. A name without such a place has none.
std::vector<CurveLabel> curve_labels(const std::vector<LaidCurve>& curves, const PaperBox& paper);

}  // namespace sim
