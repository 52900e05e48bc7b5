#pragma once
// What a module's output makes of a plan's light, burst by burst, without noise: resonator,
// comparator that follows the peak, integrator and slow AGC, each by its own equations. It is the
// rule of channel/slow_agc.hpp and channel/demodulator.hpp in continuous time, from one event to
// the next: twenty thousand bursts take some milliseconds, so a fit can try thousands of parts.
#include <cstddef>
#include <span>
#include <vector>

#include "sim/fit/plan_text.hpp"

namespace sim {

/// The constants of the rule, in its own units. Amplitudes are relative to the light of the plan's
/// first step, as a part in tune sees it.
struct RuleConstants {
  double centre_hz = 56e3, q = 10;
  double threshold = 1e-2;  // of the comparator, slow AGC at rest
  double hold_s = 0;        // of the comparator
  double integrator_s = 0;
  double atc_fraction = 0.4, atc_release_s = 10e-3;
  double attack_db_per_s = 300, release_db_per_s = 130;
  double long_burst_s = 0, free_s = 0, min_gap_s = 0, dark_hold_s = 0;
  double margin_db = 3, range_db = 120;
};

/// One burst at the output.
struct BurstOutput {
  double low_s = 0;     // how long the pin is low for it
  double start_s = 0;   // from the burst's begin to the falling edge, where there is one
  bool begins = false;  // with a falling edge; not where it goes on from the burst before
  double share = 0;     // 1: reported, 0: not; between where half a cycle decides
};

/// The bursts of all steps, in order. `bursts` is emptied first: its memory is used again.
void output_of_rule(const Plan& plan, const RuleConstants& constants,
                    std::span<const double> amplitudes, std::vector<BurstOutput>& bursts);

}  // namespace sim
