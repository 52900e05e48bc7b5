#pragma once
// A spread over units (sim/result/unit_spread) in words.
#include <string>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/result/unit_spread.hpp"

namespace sim {

/// "beyond 10 m", "3 to 5 m", "below 0.5 m".
std::string range_words(const Axis& axis, const UnitRange& range);

/// What the part as its file has it hides: "as assumed; 0.5 m to beyond 10 m for 8 of 10 units,
/// ...".
std::string doubt_words(const Axis& axis, const RangeQuantiles& quantiles, const std::string& part);

/// Whether one of the columns is the loss of which a spread is made.
bool has_loss(const std::vector<ColumnFacts>& columns);

/// A line for each row: the quantiles of its ranges.
std::string range_lines(const UnitSpread& spread);

/// As a table and a sentence; empty where there is no spread.
std::string unit_spread_lines(const Dataset& data);

}  // namespace sim
