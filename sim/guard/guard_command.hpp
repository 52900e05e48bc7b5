#pragma once
#include "sim/report/experiment_run.hpp"

namespace sim {

extern const ExperimentEngine guard_engine;

}  // namespace sim
