#include "sim/fit/output_rule.hpp"

#include <algorithm>

namespace sim {
namespace {

bool are_nearly(const std::array<double, 7>& one, const std::array<double, 7>& other) {
  return std::ranges::equal(one, other, is_nearly);
}

/// All bursts of a step, in the place of those in `bursts`. Returns how many had to be played.
std::uint64_t play_step(BurstPlayer& player, const PlanStep& step, const StepResponse& response,
                        std::vector<BurstOutput>& bursts) {
  const double on_s = static_cast<double>(step.cycles_on) * response.cycle_s;
  const double off_s = static_cast<double>(step.cycles_off) * response.cycle_s;
  const double period_s = on_s + off_s;
  player.begin_step(response, on_s, off_s);
  bursts.clear();
  auto before = player.state();
  for (std::uint64_t i = 0; i < step.repeats; ++i) {
    bursts.push_back(player.burst(step.start_ms * 1e-3 + static_cast<double>(i) * period_s));
    const auto after = player.state();
    if (i > 0 && are_nearly(before, after)) {  // so are all that follow
      const std::uint64_t left = step.repeats - 1 - i;
      bursts.insert(bursts.end(), left, bursts.back());
      player.skip(static_cast<double>(left) * period_s);
      return i + 1;
    }
    before = after;
  }
  return step.repeats;
}

}  // namespace

void OutputOfRule::play(const Plan& plan, const RuleConstants& constants,
                        std::span<const double> amplitudes,
                        const std::function<bool(std::size_t, bool)>& look) {
  if (!player_ || constants_ != constants) {
    constants_ = constants;
    player_.emplace(constants_);
    n_shown_ = 0;
  }
  player_->remember(PartMemory(constants_));
  for (std::size_t s = 0; s < plan.steps.size(); ++s)
    if (!look(s, play_anew(s, plan.steps[s], amplitudes[s]))) return;
}

bool OutputOfRule::play_anew(std::size_t s, const PlanStep& step, double amplitude) {
  const StepResponse response = response_of(step, amplitude, constants_);
  const PartMemory before = player_->memory();
  if (s < n_shown_ && played_[s].amplitude == amplitude &&
      player_->goes_on_as(played_[s].before, response, step.start_ms * 1e-3)) {
    player_->remember(played_[s].after);
    return false;
  }
  if (s == played_.size()) played_.push_back({amplitude, before, before, {}});
  bursts_played_ += play_step(*player_, step, response, played_[s].bursts);
  played_[s].amplitude = amplitude;
  played_[s].before = before;
  played_[s].after = player_->memory();
  n_shown_ = std::max(n_shown_, s + 1);
  return true;
}

}  // namespace sim
