// The mean of squared errors, whose tail to the right is long.
#include "sim/counting/skewed_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "held_intervals.hpp"
#include "sim/counting/quantiles.hpp"

namespace {

sim::SkewedMean mean_of(const std::vector<double>& values) {
  sim::SkewedMean mean;
  for (const double value : values) mean.add(value);
  return mean;
}

TEST(SkewedMean, OfSymmetricValuesIsStudents) {
  const sim::Estimate e = mean_of({8, 9, 10, 11, 12}).estimate(0.95);
  const double margin = sim::student_quantile(4, 0.95) * std::sqrt(2.5 / 5);
  EXPECT_DOUBLE_EQ(e.value, 10);
  EXPECT_NEAR(e.low, 10 - margin, 1e-9);
  EXPECT_NEAR(e.high, 10 + margin, 1e-9);
}

TEST(SkewedMean, ReachesFartherToTheLongTail) {
  const sim::Estimate e = mean_of({1, 1, 2, 1, 3, 1, 1, 2, 9, 1, 4, 1}).estimate(0.95);
  EXPECT_GT(e.high - e.value, 1.5 * (e.value - e.low));
  EXPECT_GE(e.low, 0);
}

TEST(SkewedMean, OfOneValueIsNothing) {
  EXPECT_TRUE(std::isnan(mean_of({3}).estimate(0.95).value));
  const sim::Estimate equal = mean_of({3, 3}).estimate(0.95);
  EXPECT_EQ(equal.low, 3);
  EXPECT_EQ(equal.high, 3);
}

/// Squared errors in a plane: along and across, normal, the one so many times as long.
held::Experiment errors_of(int trials, double longer) {
  return [=](std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> along(0, longer), across;
    sim::SkewedMean mean;
    for (int i = 0; i < trials; ++i)
      mean.add(std::pow(along(random), 2) + std::pow(across(random), 2));
    const sim::Estimate e = mean.estimate(0.95);
    return held::Printed{e.low, e.high, longer * longer + 1};
  };
}

TEST(HeldIntervals, MeasuredOfSquaredErrors) {
  held::expect_to_hold({"rms error", "normal errors, 20 trials", 4000}, errors_of(20, 1));
  held::expect_to_hold({"rms error", "normal errors, 200 trials", 4000}, errors_of(200, 1));
  held::expect_to_hold({"rms error", "normal errors in a thin ellipse, 200 trials", 4000},
                       errors_of(200, 5));
}

}  // namespace
