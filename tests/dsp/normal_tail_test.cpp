// The tail of the normal law against the wider arithmetic of the library, and its quantile against
// the tail.
#include "dsp/normal_tail.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

long double upper_tail(long double x) { return std::erfc(x / std::sqrt(2.0L)) / 2; }

long double density(long double x) {
  return std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi_v<long double>);
}

TEST(NormalTail, AgreesWithWiderArithmetic) {
  for (double x = -12; x < 100; x += 0.37) {
    const auto tail = dsp::normal_tail(x);
    const long double hazard = density(x) / upper_tail(x);
    const auto log_probability =
        static_cast<double>(x < 0 ? std::log1p(-upper_tail(-x)) : std::log(upper_tail(x)));
    EXPECT_NEAR(tail.log_probability / log_probability, 1, 1e-12) << x;
    EXPECT_NEAR(tail.hazard / static_cast<double>(hazard), 1, 1e-12) << x;
    EXPECT_NEAR(tail.mean_excess / static_cast<double>(hazard - x), 1, 1e-11) << x;
    EXPECT_EQ(dsp::log_upper_tail(x), tail.log_probability) << x;
  }
}

TEST(NormalTail, IsFiniteWhereProbabilitiesUnderflow) {
  for (const double x : {-1e100, -60.0, 38.0, 300.0, 1e8, 1e100}) {
    const auto tail = dsp::normal_tail(x);
    EXPECT_TRUE(std::isfinite(tail.log_probability) && std::isfinite(tail.hazard)) << x;
    EXPECT_GT(tail.mean_excess, 0) << x;
  }
  EXPECT_NEAR(dsp::normal_tail(1e8).mean_excess, 1e-8, 1e-20);
}

TEST(TruncatedNormalQuantile, IsTheInverseOfTheTail) {
  for (double bound = -12; bound < 60; bound += 0.7)
    for (const double level : {1e-30, 1e-9, 0.01, 0.3, 0.5, 0.7, 0.99, 1 - 1e-9}) {
      const double x = dsp::truncated_normal_quantile(bound, level);
      ASSERT_GE(x, bound);
      const long double off = x > 0 ? upper_tail(x) - level * upper_tail(bound)
                                    : (1.0L - level) + level * upper_tail(-bound) - upper_tail(-x);
      EXPECT_NEAR(static_cast<double>(off / density(x)), 0, 1e-12) << bound << ' ' << level;
    }
}

TEST(TruncatedNormalQuantile, OfOneIsTheBound) {
  for (const double bound : {-60.0, -8.0, 0.0, 3.0, 38.0, 1e6})
    EXPECT_NEAR(dsp::truncated_normal_quantile(bound, 1), bound, 1e-12 * (1 + std::fabs(bound)));
}

// Far out the excess over the bound is exponential of mean 1 / bound.
TEST(TruncatedNormalQuantile, FarOutIsExponential) {
  const double bound = 2000, level = 0.2;
  EXPECT_NEAR((dsp::truncated_normal_quantile(bound, level) - bound) * bound, -std::log(level),
              1e-5);
}

}  // namespace
