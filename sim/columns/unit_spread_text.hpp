#pragma once
// A spread over units (sim/result/unit_spread) in words.
#include <string>

#include "sim/result/unit_spread.hpp"

namespace sim {

/// A line for each row: the quantiles of its ranges.
std::string range_lines(const UnitSpread& spread);

/// As a table and a sentence; empty where there is no spread.
std::string unit_spread_lines(const Dataset& data);

}  // namespace sim
