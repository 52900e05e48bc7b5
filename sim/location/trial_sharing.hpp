#pragma once
// How trials of a point are shared out to threads.
#include <algorithm>
#include <cstdint>

#include "sim/threads/run_sharing.hpp"

namespace sim {

/// In lots so small that threads end together, and no more of them than about a thousand.
inline SharedRuns shared_trials(std::uint32_t trials, const Workers& workers) {
  return {.runs = trials, .most_at_once = std::max(16U, trials / 1000), .workers = workers};
}

}  // namespace sim
