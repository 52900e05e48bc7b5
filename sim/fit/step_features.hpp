#pragma once
// What is compared of a plan's step: how many of its bursts are reported, how long their pulses
// are, when they begin. The same of a recording and of the rule.
#include <cstddef>
#include <span>
#include <vector>

#include "sim/fit/output_rule.hpp"
#include "sim/fit/plan_alignment.hpp"

namespace sim {

/// Of a recording or of the rule.
struct StepFeatures {
  double reported = 0;  // bursts; of one long burst: the share of it
  double low_s = 0;     // mean of a reported burst, but for the last one
  double start_s = 0;   // mean, of those that begin a pulse; not of a train, as gain moves it
  /// Bursts until one is not reported as the first one is; below 0 where that one is not. What
  /// comes behind hangs on ever smaller differences, this does not.
  double first_run = 0;
  int with_low = 0, with_start = 0;  // bursts in these means
};

/// Bursts of all steps: where each step's begin in the list.
std::vector<std::size_t> first_bursts(const Plan& plan);

/// A burst alone that lasts so long that the gain may let go of it.
bool is_long_carrier(const PlanStep& step);

/// Bursts that follow a long carrier without a rest: when they are reported again, the gain is
/// back.
bool is_behind_carrier(const Plan& plan, std::size_t step);

/// Short bursts that the gain has nothing to do with, or a long carrier.
bool is_burst_or_carrier(const Plan& plan, std::size_t step);

/// The bursts as the recording has them; nothing of those that it does not cover.
std::vector<BurstOutput> recorded_bursts(const Plan& plan, const PinRecording& recording,
                                         const PlanAlignment& alignment);

/// Bursts that come so often that the gain may let go of them.
bool is_train(const PlanStep& step);

/// Of one step, but for the means.
StepFeatures features_of(const PlanStep& step, std::span<const BurstOutput> bursts);

/// Takes the means anew, over the bursts that both report, of a train over the first of them that
/// follow each other.
void take_means(const PlanStep& step, std::span<const BurstOutput> bursts,
                std::span<const BurstOutput> others, StepFeatures& features);

}  // namespace sim
