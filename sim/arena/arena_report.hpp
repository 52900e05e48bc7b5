#pragma once
// What people read of a single point of an arena besides its row: the devices, where messages were
// lost, and what was heard along the way.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/arena/arena_experiment.hpp"
#include "sim/columns/point_report.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Messages lost for one cause.
struct LossStage {
  std::string_view words;
  std::uint64_t lost;
};
/// Of all causes.
std::vector<LossStage> loss_stages(const SenderTally& tally);
/// How many messages are left behind each cause of loss. `end`: what those are that are left.
std::string waterfall(std::uint64_t messages, const std::vector<LossStage>& stages,
                      std::string_view end);

/// What was heard in each tenth of the way.
std::string way_table(const Scenario& scenario, const ArenaPoint& point);

extern const PointReport<ArenaPoint> arena_report;

}  // namespace sim
