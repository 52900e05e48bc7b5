#pragma once
// Ratios of powers in decibels, as tests of the theory give them.
#include <cmath>

namespace sim {

inline double ratio_of(double db) { return std::pow(10, db / 10); }

}  // namespace sim
