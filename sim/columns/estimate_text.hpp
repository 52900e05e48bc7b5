#pragma once
// Ratios and rates as people read them: with the digits that their interval supports.
#include <string>

#include "sim/counting/statistics.hpp"

namespace sim {

constexpr int estimate_width = 26;  // "1.23e-4 [1.22e-4, 1.24e-4]"

/// "0.0236 [0.0231, 0.0241]", the ends rounded outwards; with more digits where an end would look
/// like the value, as far as the column holds them; "< 1.8e-2" where nothing failed; "-" where
/// nothing was counted.
std::string estimate_text(const Estimate& e);

}  // namespace sim
