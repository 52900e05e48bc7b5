#pragma once
// What people read of an arena: a row a point while it runs, and of a single point every device,
// where messages were lost and what was heard along the way.
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/arena/arena_experiment.hpp"
#include "sim/result/dataset.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

std::string arena_header(const LoadedScenario& scenario);
std::string arena_row(const LoadedScenario& scenario, const ArenaPoint& point);

/// Devices, by their kinds where there are several of one.
std::string device_table(const ArenaPoint& point);

/// Messages lost for one cause.
struct LossStage {
  std::string_view words;
  std::uint64_t lost;
};
/// Of all fates but delivery.
std::vector<LossStage> loss_stages(const SenderTally& tally);
/// How many messages are left behind each cause of loss. `end`: what those are that are left.
std::string waterfall(std::uint64_t messages, const std::vector<LossStage>& stages,
                      std::string_view end);

/// What was heard in each tenth of the way.
std::string way_table(const Scenario& scenario, const ArenaPoint& point);

/// Everything, for files and programs.
Dataset arena_dataset(const LoadedScenario& scenario, const std::string& command,
                      const std::vector<ArenaPoint>& points);

/// A variable more for each device: `read(point, i)` gives that of the point's i-th.
void add_device_counts(Dataset& data, const std::vector<ArenaPoint>& points,
                       const std::string& name, const std::string& long_name,
                       const std::function<std::uint64_t(std::size_t, std::size_t)>& read);
void add_device_reals(Dataset& data, const std::vector<ArenaPoint>& points,
                      const VariableFacts& facts,
                      const std::function<double(std::size_t, std::size_t)>& read);

}  // namespace sim
