#pragma once
// A run of a link from its first row to its file.
#include "sim/report/experiment_run.hpp"

namespace sim {

extern const ExperimentEngine link_engine;

}  // namespace sim
