#pragma once
#include "sim/report/experiment_run.hpp"

namespace sim {

/// Runs a robo-guard: tables on stdout, all of it in a file. What is finished when an interrupt
/// comes is in both.
void run_guard_scenario(const ExperimentRun& run);

}  // namespace sim
