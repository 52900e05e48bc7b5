#pragma once
// The counters of a link's Tally, and the sums of its weights, as result files call them. Files are
// written and read by these tables, and the digest of a result is made in their order.
#include <cstdint>
#include <span>

#include "sim/counting/tally.hpp"

namespace sim {

struct TallyCounter {
  const char* name;
  const char* meaning;
  std::uint64_t Tally::*count;
};

std::span<const TallyCounter> tally_counters();

/// Of importance sampling.
struct WeightCounter {
  const char* name;
  const char* meaning;
  double& (*sum)(Weighted&);
};

std::span<const WeightCounter> weight_counters();

}  // namespace sim
