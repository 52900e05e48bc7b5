// Where the amplitude of a burst passes a level: the short way finds what a walk over all of its
// cycles does.
#include "sim/fit/burst_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sim {
namespace {

LevelCrossing walked(const BurstShape& shape, double level) {
  LevelCrossing crossing{level};
  for (const BurstCycle& cycle : shape.cycles()) crossing.step(cycle);
  return crossing;
}

/// Bursts in the ringing and behind the peak of ones before them, off the carrier too.
TEST(BurstShape, CrossingsAreThoseOfAWalk) {
  std::mt19937 draws(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(draws);
  };
  int crossed = 0, passed_twice = 0;
  for (int burst = 0; burst < 2000; ++burst) {
    RuleConstants c{};
    c.centre_hz = 56e3;
    c.q = uniform(5, 15);
    c.threshold = 1;
    c.atc_fraction = uniform(0.3, 0.8);
    c.atc_release_s = uniform(3e-3, 30e-3);
    const PlanStep step{.carrier_hz = uniform(48e3, 64e3), .cycles_on = 60};
    BurstShape shape;
    shape.play(response_of(step, 2, c), 60 / step.carrier_hz, c,
               std::polar(uniform(0, 2), uniform(-3, 3)), uniform(0, 5));
    std::size_t guess = static_cast<std::size_t>(burst % 40);
    for (const double level : {0.05, 0.3, 0.8, 1.4, 1.9, 2.1}) {
      const LevelCrossing fast = crossing_of(shape, level, guess), slow = walked(shape, level);
      ASSERT_EQ(fast.seen, slow.seen) << burst;
      ASSERT_EQ(fast.above, slow.above) << burst;
      ASSERT_EQ(fast.from, slow.from) << burst;
      ASSERT_EQ(fast.to, slow.to) << burst;
      crossed += slow.seen;
      passed_twice += slow.seen && slow.to > 0;
    }
  }
  EXPECT_GT(crossed, 4000);
  EXPECT_GT(passed_twice, 100) << "of which the short way knows nothing";
}

}  // namespace
}  // namespace sim
