#pragma once
// Counts the trials of a point of a link, in groups of eight. The stop rule looks at the sum after
// each group, never at a clock, so the result is the same for any number of threads and processes;
// work done beyond the stop is thrown away.
#include <atomic>
#include <cstdint>
#include <functional>

#include "sim/counting/stop_rule.hpp"
#include "sim/link/link.hpp"
#include "sim/result/result.hpp"

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

/// Runs one point to its stop. Coordinates are left to the caller. Throws Failure(environment) if
/// the machine does not give as many threads.
/// `before`: what an interrupt left of the same point, which is gone on with; trials are counted in
/// the order of their numbers, so it ends as if there had been no interrupt.
PointResult run_point(const Link& link, const StopRule& stop, const EngineOptions& options,
                      const PointResult& before = {});

/// Whether a point can be gone on with: only whole groups of trials can.
bool is_resumable(const PointResult& point);

/// As many threads as asked for, or if 0 one per processor that this process may run on.
int threads_for(int asked);

}  // namespace sim
