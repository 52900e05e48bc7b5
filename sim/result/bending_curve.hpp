#pragma once
// Where a curve that may bend passes a level. logit(loss) is a straight line to which an integrated
// Wiener process adds: the likeliest such curve is a cubic smoothing spline, and what it may be
// beside that is in the interval (Wahba, J. R. Statist. Soc. B 45 (1983) 133).
#include <optional>
#include <vector>

#include "sim/result/isotonic.hpp"

namespace sim {

struct CurveCrossing {
  double at = 0, low = 0, high = 0;
  std::vector<double> loss;  // of the likeliest curve, at the points
};

/// Of points along x in either direction; at least two. The interval are the places at which the
/// likelihood of all curves through the level is not surely less. Nothing where the curve
/// bends more than the counts can tell, where it does not pass the level among the points, or where
/// no end of the interval is found less than a quarter of their span beyond them.
std::optional<CurveCrossing> curve_crossing(const std::vector<double>& x, const LossCounts& counts,
                                            double level, double ci_level);

}  // namespace sim
