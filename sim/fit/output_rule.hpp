#pragma once
// What a module's output makes of a plan's light, burst by burst, without noise: resonator,
// comparator that follows the peak, integrator and slow AGC, each by its own equations. It is the
// rule of channel/slow_agc.hpp and channel/demodulator.hpp in continuous time, from one event to
// the next: twenty thousand bursts take some milliseconds, so a fit can try thousands of parts.
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "sim/fit/plan_text.hpp"
#include "sim/fit/rule_constants.hpp"

namespace sim {

/// One burst at the output.
struct BurstOutput {
  double low_s = 0;     // how long the pin is low for it
  double start_s = 0;   // from the burst's begin to the falling edge, where there is one
  bool begins = false;  // with a falling edge; not where it goes on from the burst before
  double share = 0;     // 1: reported, 0: not; between where half a cycle decides
};

/// The bursts of all steps, in order. `bursts` is emptied first: its memory is used again. Each
/// step is shown to `look` when its bursts are there; where that says no, the steps behind it are
/// not played. Returns whether all were.
bool output_of_rule(const Plan& plan, const RuleConstants& constants,
                    std::span<const double> amplitudes, std::vector<BurstOutput>& bursts,
                    const std::function<bool(std::size_t)>& look);

}  // namespace sim
