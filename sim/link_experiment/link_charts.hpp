#pragma once
// The curves of a link's result: its ratios with their intervals over a swept number.
#include <string>
#include <vector>

#include "sim/picture/chart.hpp"
#include "sim/picture/heat_map.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// BER and FLR over the number along which the ranking looks for the loss (the swept number with
/// the most values, where that one stands still), a curve for each combination of the others, and
/// theory where there is one. Points without an error are limits; those never reached are left out.
/// Of a sweep of units one chart in place of those: the share of units that carry. Empty where no
/// other number was swept.
std::vector<Chart> result_charts(const LinkResult& result);

/// FLR over the two swept numbers with the most values, a map for each combination of the others'
/// values. Empty where less than two numbers were swept.
std::vector<HeatMap> result_maps(const LinkResult& result);

}  // namespace sim
