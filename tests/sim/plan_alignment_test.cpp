// Where a plan begins in a recording, and when a recording is of another one.
#include "sim/fit/plan_alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "sim/failure.hpp"

namespace sim {
namespace {

/// Bursts at times that no clock has.
Plan uneven_plan(std::size_t bursts) {
  Plan plan;
  std::mt19937 engine(5);
  double at_ms = 0;
  for (std::size_t i = 0; i < bursts; ++i) {
    plan.steps.push_back({at_ms, 56e3, 30, 0, 1, 0});
    at_ms += 200 + static_cast<double>(engine() % 100000) * 1e-2;
  }
  return plan;
}

/// Each `one_of`th burst, in the time of a clock that is 2 % fast.
PinRecording heard_of(const Plan& plan, std::size_t one_of) {
  PinRecording recording;
  for (std::size_t i = one_of - 1; i < plan.steps.size(); i += one_of) {
    const double at_s = 3.5 + 1.02e-3 * plan.steps[i].start_ms;
    recording.pulses.push_back({at_s, at_s + 0.5e-3});
  }
  recording.end_s = recording.pulses.back().end_s + 1;
  return recording;
}

TEST(PlanAlignment, FindsBeginAndClock) {
  const Plan plan = uneven_plan(150);
  for (const std::size_t one_of : {1U, 2U, 10U}) {
    const PlanAlignment found = align(plan, heard_of(plan, one_of));
    EXPECT_NEAR(found.start_s, 3.5, 1e-6) << one_of;
    EXPECT_NEAR(found.clock_error, 0.02, 1e-9) << one_of;
    EXPECT_EQ(found.matched, static_cast<int>(150 / one_of));
  }
}

// At the best of all places some bursts of any plan lie on pulses of any recording.
TEST(PlanAlignment, RefusesARecordingOfAnotherPlan) {
  const Plan plan = uneven_plan(150);
  std::mt19937 engine(6);
  for (const std::size_t pulses : {5U, 60U, 300U}) {
    PinRecording other;
    for (std::size_t i = 0; i < pulses; ++i) {
      const double at_s =
          0.7137 * static_cast<double>(i) + 1e-5 * static_cast<double>(engine() % 30000);
      other.pulses.push_back({at_s, at_s + 0.5e-3});
    }
    other.end_s = other.pulses.back().end_s + 1;
    EXPECT_THROW(align(plan, other), Failure) << pulses;
  }
  EXPECT_THROW(align(plan, {}), Failure);
}

TEST(PlanAlignment, SaysThatTimesMayBeInAnotherUnit) {
  const Plan plan = uneven_plan(150);
  PinRecording in_ms = heard_of(plan, 2);
  for (PinPulse& pulse : in_ms.pulses) pulse.start_s *= 1e3, pulse.end_s *= 1e3;
  in_ms.end_s *= 1e3;
  try {
    align(plan, in_ms);
    FAIL() << "taken";
  } catch (const Failure& failure) {
    EXPECT_TRUE(std::string(failure.what()).ends_with("its times may be in ms: say --time-unit ms"))
        << failure.what();
  }
}

}  // namespace
}  // namespace sim
