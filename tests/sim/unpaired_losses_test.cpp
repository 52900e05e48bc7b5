// Exact tests of losses of other frames.
#include "sim/check/unpaired_losses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sim {
namespace {

// The lady tasting tea (Fisher 1935, The Design of Experiments, chapter 2): of 70 ways one has all
// four right, and 16 three of them.
TEST(FisherOneSided, IsThatOfTheLadyTastingTea) {
  EXPECT_NEAR(fisher_p_value({4, 4}, {0, 4}), 1.0 / 70, 1e-12);
  EXPECT_NEAR(fisher_p_value({3, 4}, {1, 4}), 17.0 / 70, 1e-12);
  EXPECT_NEAR(fisher_p_value({0, 4}, {4, 4}), 1, 1e-12);
  EXPECT_NEAR(fisher_p_value({0, 4}, {0, 4}), 1, 1e-12);
}

// By hand: of one lost frame the candidate, with odds of 3, has it with probability 3/4.
TEST(FisherNoWorse, IsTheLowerTailAtOdds) {
  EXPECT_NEAR(fisher_no_worse_p_value({0, 10}, {1, 10}, 3), 1.0 / 4, 1e-12);
  EXPECT_NEAR(fisher_no_worse_p_value({1, 10}, {0, 10}, 3), 1, 1e-12);
  EXPECT_NEAR(fisher_no_worse_p_value({4, 4}, {0, 4}, 2), 1, 1e-12);
}

TEST(FisherNoWorse, WithoutAMarginIsTheOtherTail) {
  for (std::uint64_t lost = 0; lost < 40; ++lost) {
    const LostOf candidate{lost, 200}, baseline{20, 300}, next{lost + 1, 200}, less{19, 300};
    EXPECT_NEAR(fisher_no_worse_p_value(candidate, baseline, 1) + fisher_p_value(next, less), 1,
                1e-9);
  }
}

TEST(Fisher, KnowsMillionsOfFrames) {
  const double p = fisher_p_value({1'010'000, 10'000'000}, {1'000'000, 10'000'000});
  EXPECT_GT(p, 0);
  EXPECT_LT(p, 1e-12);
  EXPECT_GT(fisher_p_value({1'000'100, 10'000'000}, {1'000'000, 10'000'000}), 0.3);
}

double binomial_share(std::mt19937_64& random, std::uint64_t frames, double flr) {
  return static_cast<double>(std::binomial_distribution<std::uint64_t>(frames, flr)(random));
}

TEST(Fisher, ErrsAsSeldomAsItSays) {
  std::mt19937_64 random(3);
  constexpr int checks = 20000;
  int alarms = 0, passes = 0;
  for (int i = 0; i < checks; ++i) {
    const auto lost = [&](double flr) {
      return static_cast<std::uint64_t>(binomial_share(random, 400, flr));
    };
    alarms += fisher_p_value({lost(0.1), 400}, {lost(0.1), 400}) <= 0.01;
    passes += fisher_no_worse_p_value({lost(0.15), 400}, {lost(0.1), 400}, 1.5) <= 0.01;
  }
  EXPECT_LE(alarms, checks / 100);
  EXPECT_LE(passes, checks / 100);
  EXPECT_GT(alarms, 0);
  EXPECT_GT(passes, 0);
}

}  // namespace
}  // namespace sim
