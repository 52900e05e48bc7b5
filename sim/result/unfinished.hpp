#pragma once
// A link's result by what its scenario says.
#include <string>
#include <vector>

#include "sim/result/result.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// With the points of the scenario's sweep.
LinkResult link_result(const LoadedScenario& scenario, const std::string& command,
                       std::vector<LinkPoint> points);

/// Before the first trial: points with nothing counted.
LinkResult unfinished(const LoadedScenario& scenario, const std::string& command);

}  // namespace sim
