#pragma once
#include "sim/report/experiment_run.hpp"

namespace sim {

/// Runs an arena: tables on stdout, all of it in a file. What is finished when an interrupt comes
/// is in both.
void run_arena_scenario(const ExperimentRun& run);

}  // namespace sim
