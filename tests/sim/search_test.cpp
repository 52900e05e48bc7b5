// The search brackets a known crossing, in few frames, and ends whatever the counts are.
#include "sim/engine/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "sim/counting/stop_rule.hpp"
#include "tests/sim/link_rule.hpp"

namespace sim {
namespace {

constexpr double wanted_level = 0.01;

/// A link whose loss rises with the logarithm of x, 1 % at `at`; stopped as a run is.
struct RisingLoss {
  double at, slope;
  std::mt19937_64 random{1};
  std::vector<double> looked_at{};
  std::uint64_t frames = 0;

  std::optional<Tally> operator()(double x) {
    looked_at.push_back(x);
    const double logit = std::log(wanted_level / (1 - wanted_level)) + slope * std::log(x / at);
    std::binomial_distribution<std::uint64_t> lost_of_group(8, 1 / (1 + std::exp(-logit)));
    const StopRule rule{.max_frames = 5000, .target_flr = wanted_level};
    Tally tally;
    while (!stop_reason(rule, tally)) {
      tally.n_frames += 8;
      tally.n_frames_lost += lost_of_group(random);
    }
    frames += tally.n_frames;
    return tally;
  }

  double nearest_below() const {
    double best = 0;
    for (const double x : looked_at)
      if (x <= at) best = std::max(best, x);
    return best;
  }
  double nearest_above() const {
    double best = INFINITY;
    for (const double x : looked_at)
      if (x > at) best = std::min(best, x);
    return best;
  }
};

CountAt counting(RisingLoss& link) {
  return [&](double x) { return link(x); };
}

TEST(Search, BracketsAJumpAsNarrowlyAsAsked) {
  for (const double at : {1.37, 8.21, 39.0}) {
    RisingLoss link{.at = at, .slope = 2000};
    search({.low = 1, .high = 40, .tolerance = 0.005}, wanted_level, counting(link));
    EXPECT_LT(link.nearest_above() / link.nearest_below(), 1.0051) << at;
    EXPECT_LE(link.looked_at.size(), 12u) << at;
  }
}

TEST(Search, LooksBesideAPointAtTheLevel) {
  std::vector<double> looked_at;
  const auto count = [&](double x) {
    looked_at.push_back(x);
    return Tally{.n_frames = 2000, .n_frames_lost = x < 2 ? 0u : x > 20 ? 2000u : 20u};
  };
  search({.low = 1, .high = 40}, wanted_level, count);
  ASSERT_EQ(looked_at.size(), 5u);  // the ends, the middle, and between
  EXPECT_NEAR(looked_at[2], std::sqrt(40.0), 0.01);
}

// What is far from the level gives no slope there, and a bracket of it says little.
TEST(Search, LooksBesideAPointAtTheLevelUntilTheLossIsNearIt) {
  for (const double slope : {20, 200}) {
    RisingLoss link{.at = std::sqrt(40.0), .slope = slope};
    search({.low = 1, .high = 40, .tolerance = 0.02}, wanted_level, counting(link));
    ASSERT_NEAR(link.looked_at[2], link.at, 0.01);
    const double above = link.looked_at.back();
    EXPECT_GT(above, link.at) << slope;
    EXPECT_LT(above, link.at * std::max(1.021, 1 + 3 / slope)) << slope;
    EXPECT_LE(link.looked_at.size(), 19u) << slope;
  }
}

TEST(Search, FallingLossTooAndValuesThatAreNotPositive) {
  std::vector<double> looked_at;
  const auto falls = [&](double x) {
    looked_at.push_back(x);
    return Tally{.n_frames = 2000, .n_frames_lost = x < -3.3 ? 2000u : 0u};
  };
  search({.low = -10, .high = 10, .tolerance = 0.01}, wanted_level, falls);
  std::ranges::sort(looked_at);
  const auto above = std::ranges::upper_bound(looked_at, -3.3);
  EXPECT_LT(*above - *(above - 1), 0.1 + 1e-9);
}

TEST(Search, WholeNumbersStayWhole) {
  std::vector<double> looked_at;
  const auto count = [&](double x) {
    looked_at.push_back(x);
    return Tally{.n_frames = 2000, .n_frames_lost = x >= 13 ? 2000u : 0u};
  };
  search({.low = 1, .high = 100, .tolerance = 1e-9, .whole_numbers = true}, wanted_level, count);
  EXPECT_EQ(std::ranges::count(looked_at, 12), 1);
  EXPECT_EQ(std::ranges::count(looked_at, 13), 1);
  for (const double x : looked_at) EXPECT_EQ(x, std::round(x));
}

TEST(Search, EndsWhereThereIsNothingToFind) {
  for (const std::uint64_t lost : {0u, 20u, 2000u}) {  // below, about at the level, above
    int looks = 0;
    search({.low = 1, .high = 40}, wanted_level, [&](double) {
      ++looks;
      return Tally{.n_frames = 2000, .n_frames_lost = lost};
    });
    EXPECT_LE(looks, 2) << lost;
  }
}

TEST(Search, EndsAtOnceWhenInterrupted) {
  int looks = 0;
  search({.low = 1, .high = 40}, wanted_level, [&](double) -> std::optional<Tally> {
    if (++looks == 4) return std::nullopt;
    return Tally{.n_frames = 2000, .n_frames_lost = looks == 2 ? 2000u : 0u};
  });
  EXPECT_EQ(looks, 4);
}

// Few frames do not tell that none of them is lost, but they tell the other side.
TEST(Search, AnEndOfWhichTooLittleIsKnownDoesNotEndIt) {
  std::vector<double> looked_at;
  search({.low = 1, .high = 40}, wanted_level, [&](double x) {
    looked_at.push_back(x);
    return Tally{.n_frames = 100, .n_frames_lost = x > 2.16 ? 100u : 0u};
  });
  std::ranges::sort(looked_at);
  const auto above = std::ranges::upper_bound(looked_at, 2.16);
  EXPECT_LT(*above / *(above - 1), 1.011);
  looked_at.clear();
  search({.low = 1, .high = 40}, wanted_level, [&](double x) {
    looked_at.push_back(x);
    return Tally{.n_frames = 100, .n_frames_lost = x < 2.16 ? 100u : 0u};
  });
  std::ranges::sort(looked_at);
  const auto below = std::ranges::upper_bound(looked_at, 2.16);
  EXPECT_LT(*below / *(below - 1), 1.011);
}

// A grid as fine as the bracket takes 5000 frames at each point that is near the level.
TEST(Search, TakesFarFewerFramesThanAGrid) {
  RisingLoss link{.at = 8, .slope = 100};
  search({.low = 1, .high = 40}, wanted_level, counting(link));
  RisingLoss grid{.at = 8, .slope = 100};
  for (double x = 1; x < 40; x *= 1.01) grid(x);
  EXPECT_LT(10 * link.frames, grid.frames);
}

}  // namespace
}  // namespace sim
