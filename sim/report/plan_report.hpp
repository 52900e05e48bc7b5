#pragma once
// A plan in words: `cosys-sim run --plan`.
#include <string>
#include <vector>

#include "sim/engine/plan.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// A line for each point, and their sum.
std::string plan_table(const LoadedScenario& scenario, const std::vector<RunPilot>& pilots,
                       int threads);

/// "0.25 s", "3 min 20 s", "2 h 5 min", "12 days".
std::string duration_text(double seconds);

}  // namespace sim
