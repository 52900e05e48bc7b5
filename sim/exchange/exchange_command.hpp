#pragma once
#include "sim/report/experiment_run.hpp"

namespace sim {

extern const ExperimentEngine exchange_engine;

}  // namespace sim
