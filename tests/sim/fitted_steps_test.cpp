// Whether a part follows the rule, by how far the steps of its recording are off.
#include "sim/fit/fitted_steps.hpp"

#include <gtest/gtest.h>

namespace {

/// Of one quantity, each so far off, to both sides in turn.
std::vector<sim::FittedStep> steps_off(std::size_t n, double deviation) {
  std::vector<sim::FittedStep> steps(n);
  for (std::size_t i = 0; i < n; ++i) {
    steps[i].quantity = "trains";
    steps[i].unit = "1";
    steps[i].deviation = i % 2 == 0 ? deviation : -deviation;
    steps[i].recorded = 10 + steps[i].deviation;
    steps[i].fitted = 10;
  }
  return steps;
}

TEST(FittedSteps, AreAMisfitWhereSomeAreFarOff) {
  std::vector<sim::FittedStep> steps = steps_off(30, 0.1);
  EXPECT_TRUE(sim::misfits_of(steps).empty());
  for (const std::size_t i : {3U, 9U, 15U, 21U, 27U}) {
    steps[i].deviation = 5;
    steps[i].recorded = 17;
  }
  const auto misfits = sim::misfits_of(steps);
  ASSERT_EQ(misfits.size(), 1U);
  EXPECT_EQ(misfits[0].what, "trains");
  EXPECT_EQ(misfits[0].by_how_much, "+7 bursts beside the rule in 5 of 30 steps");
}

// A plan has few steps that tell how the gain comes back, and chance does not move them.
TEST(FittedSteps, OfTheWayBackAreAMisfitWhereTwoAreFarOff) {
  std::vector<sim::FittedStep> steps = steps_off(6, 0.1);
  steps[2].deviation = steps[5].deviation = 5;
  EXPECT_TRUE(sim::misfits_of(steps).empty());
  for (sim::FittedStep& step : steps) step.evidence = sim::StepEvidence::way_back;
  EXPECT_EQ(sim::misfits_of(steps).size(), 1U);
  steps[5].deviation = 3.9;
  EXPECT_TRUE(sim::misfits_of(steps).empty()) << "one alone";
}

// Some trains are chaotic, so it takes one in twelve of them, and three.
TEST(FittedSteps, OfFirstBurstsAreAMisfitWhereManyAreVeryFarOff) {
  std::vector<sim::FittedStep> steps = steps_off(36, 0.1);
  for (sim::FittedStep& step : steps) step.evidence = sim::StepEvidence::first_bursts;
  for (const std::size_t i : {3U, 9U}) steps[i].deviation = 9;
  EXPECT_TRUE(sim::misfits_of(steps).empty());
  steps[21].deviation = 7.9;
  EXPECT_TRUE(sim::misfits_of(steps).empty());
  steps[21].deviation = 8.1;
  EXPECT_EQ(sim::misfits_of(steps).size(), 1U);
  steps[21].recorded = -1;
  EXPECT_TRUE(sim::misfits_of(steps).empty()) << "noise decides which burst is the first one";
  steps[21].recorded = 1;
  EXPECT_EQ(sim::misfits_of(steps).size(), 1U);
  steps.push_back(steps.front());
  EXPECT_TRUE(sim::misfits_of(steps).empty()) << "3 of 37";
}

TEST(FittedSteps, AreAMisfitOnTheWhole) {
  EXPECT_TRUE(sim::misfits_of(steps_off(200, 0.79)).empty());
  const auto misfits = sim::misfits_of(steps_off(200, 0.9));
  ASSERT_EQ(misfits.size(), 1U);
  EXPECT_EQ(misfits[0].what, "all steps");
  EXPECT_EQ(misfits[0].by_how_much, "0.9 standard deviations beside the rule on the whole");
  EXPECT_TRUE(sim::misfits_of(steps_off(99, 0.9)).empty()) << "too few to say";
}

TEST(FittedSteps, CountNoMoreThanThreeDeviations) {
  EXPECT_DOUBLE_EQ(sim::usual_deviation_of(steps_off(4, -2)), 2);
  EXPECT_DOUBLE_EQ(sim::usual_deviation_of(steps_off(4, 50)), 3);
  EXPECT_EQ(sim::usual_deviation_of({}), 0);
}

}  // namespace
