#pragma once
// What an experiment says to a program on stdout: one JSON object.
#include <string>

#include "sim/result.hpp"

namespace sim {

/// All counts and rates of all points by the names of the result file; what is NaN is null.
/// "crossings" is the ranking (sim/ranking) in its order: of each row where 1 % of frames is lost.
std::string to_json(const ExperimentResult& result);

}  // namespace sim
