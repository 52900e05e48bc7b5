#pragma once
// What people and programs read of how well a device is located at the points of a sweep.
#include <string>
#include <vector>

#include "sim/location/location_trials.hpp"
#include "sim/location/trial_points.hpp"
#include "sim/result/dataset.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

using LocationPointRun = TrialPoint<LocationTrialsSettings, LocationTrials>;

std::string accuracy_header(const LoadedScenario& scenario);
std::string accuracy_row(const LoadedScenario& scenario, const LocationPointRun& point);

Dataset accuracy_dataset(const LoadedScenario& scenario, const std::string& command,
                         const std::vector<LocationPointRun>& points);

}  // namespace sim
