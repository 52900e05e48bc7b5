#pragma once
// What people and programs read of presence at the points of a sweep.
#include <string>
#include <vector>

#include "sim/location/presence.hpp"
#include "sim/location/trial_points.hpp"
#include "sim/result/dataset.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

using PresencePointRun = TrialPoint<PresenceSettings, PresenceResult>;

/// Two columns for each probability of false alarm.
std::string presence_header(const LoadedScenario& scenario);
std::string presence_row(const LoadedScenario& scenario, const PresencePointRun& point);
/// The ROC of one point.
std::string roc_table(const PresencePointRun& point);

Dataset presence_dataset(const LoadedScenario& scenario, const std::string& command,
                         const std::vector<PresencePointRun>& points);

}  // namespace sim
