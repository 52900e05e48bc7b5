#include "sim/result/isotonic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

TEST(LogLikelihood, IsTheBinomial) {
  EXPECT_DOUBLE_EQ(sim::log_likelihood({10, 3}, 0.2), 3 * std::log(0.2) + 7 * std::log(0.8));
  EXPECT_EQ(sim::log_likelihood({10, 0}, 0), 0);
  EXPECT_EQ(sim::log_likelihood({5, 5}, 1), 0);
  EXPECT_EQ(sim::log_likelihood({10, 1}, 0), -INFINITY);
}

/// Of all counts at these ratios.
double likelihood(const sim::LossCounts& counts, const std::vector<double>& ratios) {
  double sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) sum += sim::log_likelihood(counts[i], ratios[i]);
  return sum;
}

TEST(IsotonicLikelihoods, ArePooledWhereRatiosFall) {
  const auto expect = [](const sim::LossCounts& counts, const std::vector<double>& ratios) {
    EXPECT_DOUBLE_EQ(sim::isotonic_likelihoods(counts, 1).back(), likelihood(counts, ratios));
  };
  expect({{10, 1}, {10, 2}, {10, 5}}, {0.1, 0.2, 0.5});
  expect({{10, 4}, {30, 8}, {60, 3}, {10, 9}}, {0.15, 0.15, 0.15, 0.9});
  expect({{10, 2}, {10, 3}, {20, 1}}, {0.15, 0.15, 0.15});  // the last two fall behind the first
  expect({}, {});
}

TEST(IsotonicLikelihoods, AreOfEachBeginningAndEndAtTheCap) {
  const sim::LossCounts counts{{10, 4}, {30, 8}, {60, 3}, {10, 9}};
  const std::vector<double> likelihoods = sim::isotonic_likelihoods(counts, 0.5);
  ASSERT_EQ(likelihoods.size(), 5U);
  EXPECT_EQ(likelihoods[0], 0);
  EXPECT_DOUBLE_EQ(likelihoods[1], likelihood({counts[0]}, {0.4}));
  EXPECT_DOUBLE_EQ(likelihoods[2], likelihood({counts[0], counts[1]}, {0.3, 0.3}));
  EXPECT_DOUBLE_EQ(likelihoods[4], likelihood(counts, {0.15, 0.15, 0.15, 0.5}));
}

// 0.99^367 is just above the 2.5 % of an end, 0.99^368 below.
TEST(IsotonicCuts, AreThoseThatTheFramesAllow) {
  const auto expect = [](const sim::LossCounts& counts, std::size_t first, std::size_t last) {
    const sim::LevelCuts cuts = sim::isotonic_cuts(counts, 0.01, 0.95);
    EXPECT_EQ(cuts.first, first);
    EXPECT_EQ(cuts.last, last);
  };
  expect({{368, 0}, {200, 200}}, 1, 1);
  expect({{367, 0}, {200, 200}}, 0, 1);
  expect({{200, 0}, {184, 0}, {184, 0}, {200, 200}}, 2, 3);
  expect({{200, 0}, {184, 0}, {183, 0}, {200, 200}}, 1, 3);
  expect({{368, 0}, {368, 0}}, 2, 2);
  expect({{400, 0}, {100, 0}}, 1, 2);
  expect({{400, 20}, {400, 20}}, 0, 0);
}

// The deviance of 8 of 300 from 1 % is 5.8, less than the 7.4 that are allowed; with the 5 of 200
// behind them it is 9.0.
TEST(IsotonicCuts, CountNeighboursTogether) {
  EXPECT_EQ(sim::isotonic_cuts({{400, 0}, {300, 8}, {300, 300}}, 0.01, 0.95).last, 2U);
  EXPECT_EQ(sim::isotonic_cuts({{400, 0}, {300, 8}, {200, 5}, {300, 300}}, 0.01, 0.95).last, 2U);
}

}  // namespace
