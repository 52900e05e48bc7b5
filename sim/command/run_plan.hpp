#pragma once
// Chooses how much is run by a plan (sim/engine/plan).
#include "sim/command/commands.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

/// `run --time-budget`: the scenario with as many frames, runs or trials a point as there is time
/// for, or as it was if interrupted. Throws Failure(bad_input) where it sweeps that number.
LoadedScenario within_budget(const RunRequest& request, const LoadedScenario& scenario,
                             const Workers& workers);

}  // namespace sim
