#pragma once
// Over how many threads trials of a point are shared out, and what ends them early.
#include <algorithm>
#include <atomic>
#include <cstdint>

#include "sim/run_sharing.hpp"

namespace sim {

struct TrialSharing {
  int threads = 1;
  const std::atomic<bool>* interrupt = nullptr;

  bool interrupted() const { return interrupt != nullptr && *interrupt; }
};

/// In lots so small that threads end together, and no more of them than about a thousand.
inline SharedRuns shared_trials(std::uint32_t trials, const TrialSharing& sharing) {
  return {.runs = trials,
          .most_at_once = std::max(16U, trials / 1000),
          .threads = sharing.threads,
          .stop = sharing.interrupt};
}

}  // namespace sim
