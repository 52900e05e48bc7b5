#pragma once
// A point of a sweep that is measured by trials.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/counting/stop_rule.hpp"

namespace sim {

template <class Settings, class Result>
struct TrialPoint {
  std::vector<double> coordinates;  // one value an axis
  Settings settings;
  std::optional<Result> result{};  // nothing: an interrupt came before any trial of it was done
  StopReason stop = StopReason::interrupted;

  bool reached() const { return result.has_value(); }
};

/// In batches so small that threads end together, and no more of them than about a thousand.
template <class Bench>
std::uint32_t trials_at_once(const Bench&, std::uint32_t trials, int /*threads*/) {
  return std::max(16U, trials / 1000);
}

}  // namespace sim
