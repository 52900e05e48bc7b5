// Rates of events that come by chance, in a rhythm or in bursts.
#include "sim/counting/event_rate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "held_intervals.hpp"

namespace {

sim::EventSums sums_of(const std::vector<std::uint64_t>& events) {
  sim::EventSums sums{.stretches = events.size()};
  for (const std::uint64_t n : events) {
    sums.events += n;
    sums.squared += n * n;
  }
  return sums;
}

void expect_by_chance(const sim::EventSums& sums, double exposure) {
  const sim::Estimate rate = sim::event_rate(sums, exposure, 0.95);
  const sim::Estimate by_chance = sim::poisson_rate(sums.events, exposure, 0.95);
  EXPECT_DOUBLE_EQ(rate.value, by_chance.value);
  EXPECT_DOUBLE_EQ(rate.low, by_chance.low);
  EXPECT_DOUBLE_EQ(rate.high, by_chance.high);
}

TEST(EventRate, IsByChanceWhereNoScatterIsSeen) {
  expect_by_chance(sums_of({0, 0, 0}), 2);
  expect_by_chance(sums_of({7}), 2);
  EXPECT_TRUE(std::isnan(sim::event_rate(sums_of({1, 1}), 0, 0.95).high));
}

// Of two stretches Student's t is wide: what is seen to scatter little is no worse than by chance.
TEST(EventRate, OfFewRegularStretchesIsNoWiderThanByChance) {
  expect_by_chance(sums_of({1, 1}), 2);
  expect_by_chance(sums_of({2, 2}), 2);
}

TEST(EventRate, IsNarrowForARhythmAndWideForBursts) {
  const std::vector<std::uint64_t> regular{25, 26, 25, 25, 26, 25, 26, 25, 25, 26};
  const std::vector<std::uint64_t> bursts{0, 90, 0, 0, 80, 0, 0, 0, 84, 0};
  const auto width = [](const std::vector<std::uint64_t>& events) {
    const sim::Estimate rate = sim::event_rate(sums_of(events), 1, 0.95);
    return rate.high - rate.low;
  };
  const sim::Estimate by_chance = sim::poisson_rate(254, 1, 0.95);
  EXPECT_LT(width(regular), 0.15 * (by_chance.high - by_chance.low));
  EXPECT_GT(width(bursts), 5 * (by_chance.high - by_chance.low));
  const sim::Estimate rate = sim::event_rate(sums_of(regular), 1, 0.95);
  EXPECT_LT(rate.low, 254);
  EXPECT_GT(rate.high, 254);
}

using Drawn = std::function<std::uint64_t(std::mt19937_64&)>;

/// So many runs, each with as many events as are drawn.
held::Experiment runs_of(std::uint64_t runs, const Drawn& drawn, double mean) {
  return [=](std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<std::uint64_t> events;
    for (std::uint64_t run = 0; run < runs; ++run) events.push_back(drawn(random));
    const sim::Estimate rate = sim::event_rate(sums_of(events), static_cast<double>(runs), 0.95);
    return held::Printed{rate.low, rate.high, mean};
  };
}

std::uint64_t by_chance(std::mt19937_64& random) {
  return static_cast<std::uint64_t>(std::poisson_distribution<int>(4)(random));
}

/// Messages of 283 ms with pauses of 0.1 to 0.9 s, in 20 s that begin anywhere.
std::uint64_t in_a_rhythm(std::mt19937_64& random) {
  std::uniform_real_distribution<double> pause(0.1, 0.9);
  constexpr double message = 0.283, run = 20, settling = 100;
  std::uint64_t whole = 0;
  for (double start = -settling; start + message < run; start += message + pause(random))
    whole += start >= 0 ? 1 : 0;
  return whole;
}

std::uint64_t in_threes(std::mt19937_64& random) { return 3 * by_chance(random); }

TEST(HeldIntervals, MeasuredOfEventsAnHour) {
  held::expect_to_hold({"accepts an hour", "60 runs, by chance 4 each", 1000},
                       runs_of(60, by_chance, 4));
  held::expect_to_hold({"accepts an hour", "60 runs, by chance 4 times 3 each", 1000},
                       runs_of(60, in_threes, 12));
  constexpr double mean = (20 - 0.283) / (0.283 + 0.5);
  held::expect_to_hold({"accepts an hour", "60 runs of 20 s, a neighbour's rhythm", 1000},
                       runs_of(60, in_a_rhythm, mean));
  held::expect_to_hold({"accepts an hour", "6 runs of 20 s, a neighbour's rhythm", 1000},
                       runs_of(6, in_a_rhythm, mean));
}

}  // namespace
