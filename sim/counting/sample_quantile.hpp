#pragma once
// Quantiles of what was measured or drawn.
#include <vector>

namespace sim {

/// The value below which such a share of a sample lies, straight between neighbours: type 7 of
/// Hyndman & Fan (The American Statistician 50, 1996). 0.5 is the median. NaN of no values.
double sample_quantile(std::vector<double> values, double share);

}  // namespace sim
