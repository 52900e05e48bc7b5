#pragma once
// What a module's output makes of a plan's light, burst by burst, without noise. Twenty thousand
// bursts take some milliseconds, so a fit can try thousands of parts.
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sim/fit/burst_player.hpp"
#include "sim/fit/plan_text.hpp"
#include "sim/fit/rule_constants.hpp"

namespace sim {

/// Plays a plan for one set of constants and of light after the other. A step is played again only
/// where the constants, its light, or what the steps before it left behind are others: what one
/// level changes is a few steps.
class OutputOfRule {
 public:
  OutputOfRule() = default;
  OutputOfRule(const OutputOfRule&) = delete;  // what it has played refers to its constants
  OutputOfRule& operator=(const OutputOfRule&) = delete;

  /// Shows each step to `look` when its bursts are there, and says whether they are others than
  /// when it was shown last. Where `look` says no, the steps behind are not played. The plan is the
  /// same each time.
  void play(const Plan& plan, const RuleConstants& constants, std::span<const double> amplitudes,
            const std::function<bool(std::size_t step, bool is_new)>& look);

  /// Of a step that was shown.
  const std::vector<BurstOutput>& bursts(std::size_t step) const { return played_[step].bursts; }
  /// Of all plays so far: the work that was done.
  std::uint64_t bursts_played() const { return bursts_played_; }

 private:
  struct PlayedStep {
    double amplitude;
    PartMemory before, after;
    std::vector<BurstOutput> bursts;
  };

  /// Whether the step had to be played.
  bool play_anew(std::size_t s, const PlanStep& step, double amplitude);

  RuleConstants constants_;
  std::optional<BurstPlayer> player_;
  std::vector<PlayedStep> played_;  // their memory is used again
  std::size_t n_shown_ = 0;         // with these constants
  std::uint64_t bursts_played_ = 0;
};

}  // namespace sim
