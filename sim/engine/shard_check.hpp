#pragma once
// Whether the runs of an experiment can be shared out.
#include <cstdint>

#include "sim/counting/shard.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Throws Failure(bad_input) where a point, whose runs are counted in such groups, cannot be shared
/// out like this.
void check_shard(const LoadedScenario& scenario, const Shard& shard, std::uint32_t group);

}  // namespace sim
