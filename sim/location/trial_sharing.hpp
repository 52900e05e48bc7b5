#pragma once
// Over how many threads trials of a point are shared out, and what ends them early.
#include <atomic>

namespace sim {

struct TrialSharing {
  int threads = 1;
  const std::atomic<bool>* interrupt = nullptr;

  bool interrupted() const { return interrupt != nullptr && *interrupt; }
};

}  // namespace sim
