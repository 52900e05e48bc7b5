#pragma once
// `cosys-sim run` of a scenario of presence or of location.
#include "sim/report/experiment_run.hpp"

namespace sim {

/// Table to stdout, dataset to the output.
void run_presence_scenario(const ExperimentRun& run);
void run_location_scenario(const ExperimentRun& run);

}  // namespace sim
