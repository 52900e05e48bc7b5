#pragma once
// What cosys-sim run does with a scenario that is no link: a row of the table in experiments.cpp
// for each experiment (sim/scenario/experiment_kind).
#include "sim/report/experiment_run.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Throws for keys that mean nothing in the scenario's experiment, and for what is wrong at any of
/// its points.
void check_experiment(const LoadedScenario& scenario);

using RunExperiment = void (*)(const ExperimentRun&);

/// Nothing for a link.
RunExperiment runner_of(const LoadedScenario& scenario);

}  // namespace sim
