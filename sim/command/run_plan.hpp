#pragma once
// What cosys-sim run does with a plan (sim/engine/plan): print it, or choose the frames by it.
#include "sim/command/commands.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

/// `run --time-budget`: the scenario with as many frames, runs or trials a point as there is time
/// for, or as it was if interrupted. Throws Failure(bad_input) where it sweeps that number.
LoadedScenario within_budget(const RunRequest& request, const LoadedScenario& scenario,
                             const Workers& workers);

}  // namespace sim
