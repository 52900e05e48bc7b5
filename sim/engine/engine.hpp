#pragma once
// The Monte Carlo engine: groups of eight trials on a pool of threads, added up in the order of
// their numbers. The stop rule looks at that sum after each group, never at a clock, so the result
// is the same for any number of threads; work done beyond the stop is thrown away.
#include "sim/counting/stop_rule.hpp"
#include "sim/engine/engine_options.hpp"
#include "sim/link/link.hpp"
#include "sim/result/result.hpp"

namespace sim {

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
