#pragma once
// Runs of an arena: all devices send, the receiver goes its way, and each message is
// delivered or lost for one cause.
// The walk is that of sim/trial/trial.hpp with many senders: their light adds up in the chain.
#include <atomic>
#include <cstdint>
#include <vector>

#include "sim/arena/arena.hpp"
#include "sim/arena/arena_tally.hpp"

namespace sim {

struct ArenaRuns {
  ArenaTally tally;
  std::vector<HeardFrame> heard;  // by run and time

  /// Adds the runs behind these.
  ArenaRuns& operator+=(const ArenaRuns& next);
  template <class Archive>
  void serialize(Archive& archive) {
    archive(tally, heard);
  }
};

/// Runs first ... first + n - 1, at once as far as the processor has lanes. Worth nothing once
/// `*stop` is true: it then gives up soon.
ArenaRuns run_arena(const Arena& arena, std::uint32_t first, int n,
                    const std::atomic<bool>* stop = nullptr);

}  // namespace sim
