#pragma once
// What a link says to a program on stdout: one JSON object.
#include <string>

#include "sim/result/ranking.hpp"
#include "sim/result/result.hpp"

namespace sim {

/// All counts and rates of all points by the names of the result file; what is NaN is null.
/// "crossings" is the ranking (sim/result/ranking) in its order: of each row where the loss passes
/// the level, 1 % if no other is asked for.
std::string to_json(const ExperimentResult& result, const CrossingQuestion& question = {});

}  // namespace sim
