#pragma once
// Over how many threads trials of a point are shared out, and what ends them early.
#include <atomic>
#include <cstdint>
#include <limits>

#include "sim/run_sharing.hpp"

namespace sim {

struct TrialSharing {
  int threads = 1;
  const std::atomic<bool>* interrupt = nullptr;

  bool interrupted() const { return interrupt != nullptr && *interrupt; }
};

inline SharedRuns shared_trials(std::uint32_t trials, const TrialSharing& sharing) {
  return {.runs = trials,
          .most_at_once = std::numeric_limits<std::uint32_t>::max(),
          .threads = sharing.threads,
          .stop = sharing.interrupt};
}

}  // namespace sim
