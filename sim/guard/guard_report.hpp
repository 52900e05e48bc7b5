#pragma once
// What people read of a robo-guard, and everything for files and programs.
#include <string>
#include <vector>

#include "sim/guard/guard_experiment.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

std::string guard_header(const LoadedScenario& scenario);
std::string guard_row(const LoadedScenario& scenario, const GuardPoint& point);

/// "17.6 %"; "-" where it is not known.
std::string percent_text(double share);

/// Of each device: messages on their way, and how old the base station's knowledge is.
std::string mirror_table(const GuardPoint& point);
/// From the devices' messages to the base station; adds up.
std::string guard_waterfall(const GuardPoint& point);

Dataset guard_dataset(const LoadedScenario& scenario, const std::string& command,
                      const std::vector<GuardPoint>& points);

}  // namespace sim
