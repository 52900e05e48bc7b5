#pragma once
// What people and programs read of listening.
#include <string>
#include <vector>

#include "sim/listening/listening_experiment.hpp"
#include "sim/report/experiment_run.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

/// Columns of what the device sends are there only where it may send.
std::string listening_header(const LoadedScenario& scenario);
std::string listening_row(const LoadedScenario& scenario, const ListeningPoint& point);

Dataset listening_dataset(const LoadedScenario& scenario, const std::string& command,
                          const std::vector<ListeningPoint>& points);

extern const ExperimentEngine listening_engine;

}  // namespace sim
