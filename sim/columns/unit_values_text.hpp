#pragma once
// What units say together in an experiment that has no frame loss of a point.
#include <string>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

/// Of each headed number of a point its 10 % quantile, median and 90 % quantile over the units, as
/// a table; empty where there are no units, or where unit_spread_lines says what they carry.
std::string unit_value_lines(const Dataset& data, const std::vector<ColumnFacts>& columns);

}  // namespace sim
