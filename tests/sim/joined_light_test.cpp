// Captures of one module one behind the other: which steps count, and what is known of their light.
#include "sim/fit/joined_light.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim/failure.hpp"

namespace sim {
namespace {

constexpr double carrier_hz = 56e3;
constexpr double error_db = 0.6;

/// Short bursts, long carriers at three levels, a train, and short bursts again.
Plan some_plan() {
  Plan plan;
  const auto add = [&](PlanStep step) {
    step.start_ms = plan.steps.empty() ? 0 : end_ms(plan.steps.back()) + 500;
    step.carrier_hz = carrier_hz;
    plan.steps.push_back(step);
  };
  for (const double db : {0.0, -20.0})
    add({.cycles_on = 30, .cycles_off = 1000, .repeats = 5, .level_db = db});
  for (const double db : {-40.0, -20.0, 0.0}) add({.cycles_on = 60000, .level_db = db});
  add({.cycles_on = 150, .cycles_off = 400, .repeats = 50, .level_db = -20});
  add({.cycles_on = 30, .cycles_off = 1000, .repeats = 5, .level_db = -20});
  return plan;
}

/// A module that reports all light, for some cycles longer than it was there.
PinRecording recording_of(const Plan& plan, double longer_cycles = 2) {
  PinRecording recording;
  for (const PlanStep& step : plan.steps)
    for (std::uint64_t i = 0; i < step.repeats; ++i) {
      const double cycle_s = 1 / step.carrier_hz;
      const double begin_s = 0.3 + step.start_ms * 1e-3 +
                             cycle_s * static_cast<double>(i * (step.cycles_on + step.cycles_off));
      recording.pulses.push_back(
          {begin_s, begin_s + cycle_s * (static_cast<double>(step.cycles_on) + longer_cycles)});
    }
  recording.end_s = recording.pulses.back().end_s + 1;
  return recording;
}

LightCapture heard_capture(const Plan& plan, std::optional<double> level = std::nullopt,
                           double ambient = 0) {
  return {plan, recording_of(plan), level, ambient};
}

TEST(JoinedLight, IsOfOneCaptureWhatItIs) {
  const Plan plan = some_plan();
  const JoinedLight light = join({heard_capture(plan, 60)}, error_db);
  EXPECT_EQ(light.plan, plan);
  EXPECT_EQ(light.steps.size(), plan.steps.size());
  EXPECT_EQ(light.recorded.size(), first_bursts(plan).back());
  EXPECT_NEAR(light.captures[0].alignment.start_s, 0.3, 1e-6);
}

TEST(JoinedLight, IsCutToTheFirstBurstsOfItsTrains) {
  const Plan plan = some_plan();
  const JoinedLight light = join({heard_capture(plan)}, error_db);
  const JoinedLight cut = cut_trains(light, 3);
  ASSERT_EQ(cut.plan.steps.size(), plan.steps.size());
  EXPECT_EQ(cut.recorded.size(), 3U + 3U + 3 * 1U + 3U + 3U);
  const auto first = first_bursts(plan), first_of_cut = first_bursts(cut.plan);
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    EXPECT_EQ(cut.plan.steps[s].repeats, std::min<std::uint64_t>(3, plan.steps[s].repeats));
    for (std::size_t i = 0; i < cut.plan.steps[s].repeats; ++i)
      EXPECT_EQ(cut.recorded[first_of_cut[s] + i].low_s, light.recorded[first[s] + i].low_s);
  }
  EXPECT_EQ(cut_trains(light, 1000).plan, plan);
}

// Of the second one the train tells nothing new, and what comes behind it begins with less gain.
TEST(JoinedLight, TakesOfARepeatedPlanTheStepsBeforeItsFirstTrain) {
  const Plan plan = some_plan();
  const JoinedLight light = join({heard_capture(plan), heard_capture(plan)}, error_db);
  ASSERT_EQ(light.steps.size(), 7U + 5U);
  EXPECT_EQ(light.steps[7].capture, 1U);
  EXPECT_EQ(light.steps.back().step, 4U);
  EXPECT_EQ(light.captures[1].levels_of, 0U) << "its levels are as wrong";
  EXPECT_GE(light.plan.steps[7].start_ms, end_ms(light.plan.steps[6]) + 1e5) << "all gain is back";
  Plan other = plan;
  other.steps[0].repeats = 6;
  const JoinedLight both = join({heard_capture(plan), heard_capture(other)}, error_db);
  EXPECT_EQ(both.steps.size(), 14U) << "a plan of its own counts whole";
  EXPECT_EQ(both.captures[1].levels_of, 1U);
  EXPECT_EQ(
      join({heard_capture(plan), heard_capture(other, std::nullopt, 10)}, error_db).steps.size(),
      12U)
      << "but not under a lamp";
}

TEST(JoinedLight, TakesNoStepsBehindARecordingThatWasCutShort) {
  Plan plan = some_plan();
  plan.steps.push_back({end_ms(plan.steps.back()) + 12e3, carrier_hz, 30, 1000, 5, -20});
  LightCapture capture = heard_capture(plan);
  std::erase_if(capture.recording.pulses, [&](const PinPulse& pulse) {
    return pulse.start_s > 0.3 + 1e-3 * plan.steps[5].start_ms;
  });
  capture.recording.end_s = capture.recording.pulses.back().end_s;
  EXPECT_EQ(join({capture}, error_db).steps.size(), 5U);
  capture.recording.end_s += 12;
  EXPECT_EQ(join({capture}, error_db).steps.size(), 8U) << "the last one may have been too weak";
}

// A wire of the LED has light of any level alike. Where all levels are nearly one, a module may,
// too.
TEST(JoinedLight, RefusesTheWireOfTheLight) {
  Plan plan = some_plan();
  EXPECT_THROW(join({{plan, recording_of(plan, 0), 60, 0}}, error_db), Failure);
  for (PlanStep& step : plan.steps) step.level_db /= 3;
  EXPECT_NO_THROW(join({{plan, recording_of(plan, 0), 60, 0}}, error_db));
}

TEST(JoinedLight, KnowsLightAsWellAsItIsTold) {
  const Plan plan = some_plan();
  const JoinedLight light = join({heard_capture(plan, 60), heard_capture(plan, 600),
                                  heard_capture(plan), heard_capture(plan, 60, 10)},
                                 error_db);
  EXPECT_NEAR(light.captures[1].level.middle, 20, 1e-9);
  EXPECT_EQ(light.captures[1].level.deviation, error_db);
  EXPECT_GT(light.captures[2].level.deviation, 10);
  EXPECT_LT(light.captures[3].level.middle, 0) << "a lamp makes light seem weaker";
  EXPECT_GT(light.captures[3].level.deviation, 3);
}

// A line through levels x has a slope of standard deviation s / sqrt(sum (x - mean)^2): 0.6 dB over
// 28.28 dB.
TEST(JoinedLight, ScaleIsAsSureAsCarriersAreFarApart) {
  const Plan plan = some_plan();
  EXPECT_NEAR(scale_error(join({heard_capture(plan)}, error_db), error_db), 0.6 / std::sqrt(800),
              1e-12);
  Plan one = plan;
  one.steps.erase(one.steps.begin() + 3, one.steps.begin() + 5);
  EXPECT_EQ(scale_error(join({heard_capture(one)}, error_db), error_db), 0) << "of one level alone";
}

}  // namespace
}  // namespace sim
