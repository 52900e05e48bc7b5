// A plan that is played again: what one number changes comes out as if all was played anew.
#include "sim/fit/output_rule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace sim {
namespace {

RuleConstants slow_part() {
  RuleConstants c;
  c.centre_hz = 56e3;
  c.hold_s = 20e-6;
  c.integrator_s = 100e-6;
  c.long_burst_s = 1e-3;
  c.free_s = 0.2e-3;
  c.min_gap_s = 0.5e-3;
  c.dark_hold_s = 12e-3;
  return c;
}

PlanStep played_step(double start_ms, std::uint64_t on, std::uint64_t off, std::uint64_t repeats) {
  PlanStep step;
  step.start_ms = start_ms;
  step.carrier_hz = 56e3;
  step.cycles_on = on;
  step.cycles_off = off;
  step.repeats = repeats;
  return step;
}

/// A carrier, weak bursts in its wake, and others behind a rest: of 3 s, and of 30 ms.
Plan plan_with_wakes() {
  Plan plan;
  plan.steps = {played_step(0, 16800, 56, 1),    played_step(302, 30, 200, 40),
                played_step(3500, 150, 300, 60), played_step(4000, 30, 200, 8),
                played_step(4060, 30, 200, 8),   played_step(4095.5, 300, 100, 30)};
  return plan;
}

struct PlayedAgain {
  std::vector<std::vector<BurstOutput>> bursts;
  std::vector<bool> is_new;
};

PlayedAgain played(OutputOfRule& rule, const RuleConstants& c, const std::vector<double>& light) {
  PlayedAgain all;
  rule.play(plan_with_wakes(), c, light, [&](std::size_t s, bool is_new) {
    all.bursts.push_back(rule.bursts(s));
    all.is_new.push_back(is_new);
    return true;
  });
  return all;
}

void expect_alike(const PlayedAgain& one, const PlayedAgain& other) {
  ASSERT_EQ(one.bursts.size(), other.bursts.size());
  for (std::size_t s = 0; s < one.bursts.size(); ++s) {
    ASSERT_EQ(one.bursts[s].size(), other.bursts[s].size()) << "step " << s;
    for (std::size_t i = 0; i < one.bursts[s].size(); ++i) {
      const BurstOutput &a = one.bursts[s][i], &b = other.bursts[s][i];
      EXPECT_NEAR(a.low_s, b.low_s, 1e-9) << "step " << s << ", burst " << i;
      EXPECT_NEAR(a.start_s, b.start_s, 1e-9) << "step " << s << ", burst " << i;
      EXPECT_NEAR(a.share, b.share, 1e-6) << "step " << s << ", burst " << i;
    }
  }
}

class OutputOfRuleAgain : public ::testing::Test {
 protected:
  OutputOfRuleAgain() : first_(play(light_)) {}

  PlayedAgain play(const std::vector<double>& light) { return played(rule_, part_, light); }
  PlayedAgain anew(const std::vector<double>& light) const {
    OutputOfRule rule;
    return played(rule, part_, light);
  }

  RuleConstants part_ = slow_part();
  std::vector<double> light_ = std::vector<double>(6, 0.5);
  OutputOfRule rule_;
  PlayedAgain first_;
};

TEST_F(OutputOfRuleAgain, IsAsPlayedAnew) {
  for (std::size_t s = 0; s < light_.size(); ++s) {
    std::vector<double> other = light_;
    other[s] = 0.05;
    expect_alike(play(other), anew(other));
    expect_alike(play(light_), first_);
  }
}

// The carrier, and the bursts in its wake; behind the rest nothing is left of it.
TEST_F(OutputOfRuleAgain, PlaysOnlyWhatAnotherLevelChanges) {
  EXPECT_EQ(first_.is_new, std::vector<bool>(6, true));
  EXPECT_EQ(play(light_).is_new, std::vector<bool>(6, false));
  light_[0] = 2;
  EXPECT_EQ(play(light_).is_new, (std::vector<bool>{true, true, false, false, false, false}));
}

TEST_F(OutputOfRuleAgain, PlaysAllForOtherConstants) {
  part_.release_db_per_s = 60;
  const PlayedAgain again = play(light_);
  EXPECT_EQ(again.is_new, std::vector<bool>(6, true));
  expect_alike(again, anew(light_));
}

TEST_F(OutputOfRuleAgain, KnowsNothingOfStepsThatItDidNotGetTo) {
  part_.attack_db_per_s = 500;
  rule_.play(plan_with_wakes(), part_, light_, [](std::size_t s, bool) { return s < 2; });
  EXPECT_EQ(play(light_).is_new, (std::vector<bool>{false, false, false, true, true, true}));
}

}  // namespace
}  // namespace sim
