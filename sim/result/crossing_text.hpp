#pragma once
// Crossings in words, with the digits that their intervals support.
#include <string>

#include "sim/result/curve_fit.hpp"

namespace sim {

/// "frame loss crosses 1 % at receiver.range_m = 7.88 [7.60, 8.20] m"
std::string crossing_sentence(const Axis& axis, const Crossing& crossing, double level = 0.01);

/// The same in few words, for a list whose head says the rest: "7.88 [7.60, 8.20] m".
std::string crossing_words(const Axis& axis, const Crossing& crossing, double level = 0.01);

}  // namespace sim
