#pragma once
// What a link says to a program on stdout: one JSON object.
#include <string>

#include "sim/result/dataset.hpp"
#include "sim/result/ranking.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// All variables of the points, which `data` has of the same result; what is NaN is null.
/// "crossings" is the ranking (sim/result/ranking) in its order: of each row where the loss passes
/// the level, 1 % if no other is asked for.
std::string to_json(const LinkResult& result, const Dataset& data,
                    const CrossingQuestion& question = {});

}  // namespace sim
