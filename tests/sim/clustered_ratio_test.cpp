// Ratios of sums over runs in which what is counted may hang together.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "sim/counting/statistics.hpp"

namespace {

bool covers(const sim::Estimate& ci, double truth) { return ci.low <= truth && truth <= ci.high; }

sim::ClusterSums clusters(const std::vector<std::pair<int, int>>& part_and_whole) {
  sim::ClusterSums sums;
  for (const auto& [part, whole] : part_and_whole)
    sums.add(static_cast<std::uint64_t>(part), static_cast<std::uint64_t>(whole));
  return sums;
}

/// Runs in `bad` of which on average messages are lost at 0.5, in the others at 0.05.
sim::ClusterSums runs(int n, double bad, int messages, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  sim::ClusterSums sums;
  for (int run = 0; run < n; ++run) {
    const double p = uniform(random) < bad ? 0.5 : 0.05;
    std::uint64_t lost = 0;
    for (int i = 0; i < messages; ++i) lost += uniform(random) < p;
    sums.add(lost, static_cast<std::uint64_t>(messages));
  }
  return sums;
}

double clustered_coverage(int n, double bad) {
  constexpr int experiments = 8000;
  std::mt19937_64 random(7);
  double covered = 0;
  for (int i = 0; i < experiments; ++i) {
    const sim::Estimate e = sim::clustered_ratio(runs(n, bad, 50, random), 0.95);
    covered += covers(e, bad * 0.5 + (1 - bad) * 0.05) / double{experiments};
  }
  return covered;
}

sim::Interval plain_interval(const sim::ClusterSums& sums) {
  return sim::clopper_pearson(static_cast<double>(sums.part), static_cast<double>(sums.whole),
                              0.95);
}

// Clopper-Pearson on the counts holds the truth in 40 and 39 % of the first two.
TEST(ClusteredRatio, MeasuredCoversTheTruthWhenLossesOfARunHangTogether) {
  for (const int n : {8, 30}) {
    EXPECT_GE(clustered_coverage(n, 0.4), 0.94) << n;
    EXPECT_LE(clustered_coverage(n, 0.4), 0.985) << n;
  }
  EXPECT_GE(clustered_coverage(8, 0), 0.95) << "independent";
}

// By hand: ratio 0.2, residuals 0, 5, -5 and 0 of wholes of 50, so the variance is 4 / 3 * 50 /
// 200^2 = 1 / 600 and 0.2 * 0.8 * 600 = 96 are effective; Student's t at 3 and 199 degrees of
// freedom: 3.182446 and 1.971957.
TEST(ClusteredRatio, IsKornAndGraubards) {
  const sim::Estimate e =
      sim::clustered_ratio(clusters({{10, 50}, {15, 50}, {5, 50}, {10, 50}}), 0.95);
  const double effective = 96 * std::pow(1.971957 / 3.182446, 2);
  const auto expected = sim::clopper_pearson(0.2 * effective, effective, 0.95);
  EXPECT_EQ(e.value, 0.2);
  EXPECT_NEAR(e.low, expected.low, 1e-6);
  EXPECT_NEAR(e.high, expected.high, 1e-6);
}

TEST(ClusteredRatio, IsNeverNarrowerThanClopperPearsonOnTheCounts) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 500; ++i) {
    const auto sums = runs(2 + i % 20, 0.3 * (i % 3), 1 + i % 70, random);
    const sim::Estimate e = sim::clustered_ratio(sums, 0.95);
    const sim::Interval plain = plain_interval(sums);
    EXPECT_LE(e.low, plain.low + 1e-12);
    EXPECT_GE(e.high, plain.high - 1e-12);
  }
}

TEST(ClusteredRatio, IsClopperPearsonWhereNoSpreadIsSeen) {
  for (const auto& sums : {clusters({{7, 50}}), clusters({{0, 50}, {0, 40}}),
                           clusters({{50, 50}, {40, 40}}), clusters({{5, 50}, {4, 40}})}) {
    const sim::Estimate e = sim::clustered_ratio(sums, 0.95);
    EXPECT_EQ(e.low, plain_interval(sums).low);
    EXPECT_EQ(e.high, plain_interval(sums).high);
  }
}

// Two runs are two trials at least, whatever Student's t says of one degree of freedom.
TEST(ClusteredRatio, OfAllOrNothingCountsTheClusters) {
  const sim::Estimate two = sim::clustered_ratio(clusters({{50, 50}, {0, 50}}), 0.95);
  EXPECT_NEAR(two.low, sim::clopper_pearson(1, 2, 0.95).low, 1e-12);
  EXPECT_NEAR(two.high, sim::clopper_pearson(1, 2, 0.95).high, 1e-12);
}

TEST(ClusteredRatio, TakesNoClusterWithoutAnythingCounted) {
  EXPECT_EQ(clusters({{5, 50}, {0, 0}, {9, 50}}), clusters({{5, 50}, {9, 50}}));
  const sim::Estimate e = sim::clustered_ratio({}, 0.95);
  EXPECT_TRUE(std::isnan(e.value) && std::isnan(e.low) && std::isnan(e.high));
}

TEST(ClusteredRatio, AddsClustersInAnyOrder) {
  sim::ClusterSums sums = clusters({{3, 40}});
  sums += clusters({{1, 20}, {9, 60}});
  EXPECT_EQ(sums, clusters({{9, 60}, {3, 40}, {1, 20}}));
  EXPECT_EQ(sums, (sim::ClusterSums{.n = 3,
                                    .part = 13,
                                    .whole = 120,
                                    .part_squared = 91,
                                    .part_times_whole = 680,
                                    .whole_squared = 5600}));
}

}  // namespace
