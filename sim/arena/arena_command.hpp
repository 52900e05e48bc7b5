#pragma once
#include "sim/report/experiment_run.hpp"

namespace sim {

extern const ExperimentEngine arena_engine;

}  // namespace sim
