#pragma once
#include <string>

#include "sim/result/result.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// The experiment before its first trial: axes, and points with nothing counted.
ExperimentResult unfinished(const LoadedScenario& scenario, const std::string& command);

}  // namespace sim
