#pragma once
// What people read of an arena: a row a point while it runs, and of a single point every device,
// where messages were lost and what was heard along the way.
#include <string>
#include <vector>

#include "sim/arena/arena_experiment.hpp"
#include "sim/dataset.hpp"
#include "sim/scenario.hpp"

namespace sim {

std::string arena_header(const std::vector<Axis>& axes);
std::string arena_row(const std::vector<Axis>& axes, const ArenaPoint& point);

/// Devices, by their kinds where there are several of one.
std::string device_table(const ArenaPoint& point);
/// How many messages were left behind each cause of loss; adds up.
std::string waterfall(const SenderTally& tally);
/// What was heard in each tenth of the way.
std::string way_table(const Scenario& scenario, const ArenaPoint& point);

/// Everything, for files and programs.
Dataset arena_dataset(const LoadedScenario& scenario, const std::string& command,
                      const std::vector<ArenaPoint>& points);

}  // namespace sim
