#pragma once
// What those who count the trials of a point are told, and the point that they make of their sum.
#include <atomic>
#include <cstdint>
#include <functional>

#include "sim/link/link.hpp"
#include "sim/result/result.hpp"
#include "sim/trial/trial.hpp"

namespace sim {

class ProcessGroup;

struct EngineOptions {
  int threads = 1;
  std::uint64_t first_trial = 0;      // of the point's trials; starts a whole group of eight
  bool profiled = false;              // with PointResult::profile
  ProcessGroup* processes = nullptr;  // processes to share the trials with
  const std::atomic<bool>* interrupt = nullptr;  // polled; ends the point with what is complete
  /// From the calling thread, a few times a second: what an interrupt would leave now.
  std::function<void(const PointResult&)> on_progress{};
};

/// What was counted so far, as a point.
inline PointResult as_point(const GroupResult& sum, StopReason stop, const Link& link,
                            double elapsed_s) {
  return {.operating = link.operating,
          .tally = sum.tally,
          .stop = stop,
          .elapsed_s = elapsed_s,
          .simulated_s = sum.simulated_s,
          .n_samples = sum.n_samples,
          .outside = link.outside,
          .profile = sum.profile};
}

}  // namespace sim
