#pragma once
// How many trials a thread takes at once, by lanes, memory and time.
#include <cstdint>

#include "channel/chain.hpp"
#include "sim/link/link.hpp"

namespace sim {

/// Trials of a group, which are counted together.
constexpr std::uint32_t group_size = channel::lanes_per_group;

/// Of a thread: trials, in whole groups.
struct BatchSizes {
  std::uint32_t least, most;
};

/// Many where a group is over in a microsecond, which a lock takes too; else as many as the
/// processor has lanes for. Of waveforms up to eight times as many, about a second's work: of more
/// trials more are of like length (channel::propagate). Importance sampling keeps the noise of all
/// trials of a batch, so it is not given more.
BatchSizes batch_sizes(const Link& link);

}  // namespace sim
