#pragma once
// Whether the runs of an experiment can be shared out.
#include <cstdint>

#include "sim/counting/shard.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Throws Failure(bad_input) where a point cannot be shared out like this. Its runs are counted in
/// groups of this size; `counts_losses`: stop.max_frame_errors is a rule of the experiment.
void check_shard(const LoadedScenario& scenario, const Shard& shard, std::uint32_t group,
                 bool counts_losses);

}  // namespace sim
