#pragma once
// What a link says to a program on stdout: one JSON object.
#include <string>

#include "sim/result/dataset.hpp"
#include "sim/result/ranking.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// All variables of the points, which `data` has of the same result; what is NaN is null.
/// "crossings" is the ranking (sim/result/ranking) of the result in its order: of each row where
/// the loss passes the level, with its doubt, if it has one. "units" is what a sweep of units says
/// of its other axes (sim/result/unit_spread_json).
std::string to_json(const LinkResult& result, const Dataset& data, const Ranking& ranking);

}  // namespace sim
