// The slow AGC's rule: what is charged, what is let down, when a burst ends. Eight lanes equal one
// is tested with the whole chain.
#include "channel/slow_agc.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gtest/gtest.h"

namespace channel {
namespace {

constexpr int tick = 10;
constexpr SlowAgcDesign design{.long_burst = 800,
                               .min_gap = 300,
                               .free = 0,
                               .hold = 0,
                               .attack = 0.01f,
                               .release = 0.004f,
                               .range = 60,
                               .margin = 0.7f,
                               .samples_per_tick = tick};

double in_db(float factor) { return 20 * std::log10(static_cast<double>(factor)); }

/// An AGC and a clock: bursts and gaps of any length, wherever they fall on the grid of ticks.
class Timeline {
 public:
  explicit Timeline(double start, const SlowAgcDesign& d = design) : agc_(d) { dark(start); }

  Timeline& lit(double samples) { return pass(samples, 1); }
  Timeline& dark(double samples) { return pass(samples, 0); }
  /// dB after the ticks that have ended.
  double gain() const { return in_db(gain_); }

 private:
  Timeline& pass(double samples, double active) {
    while (samples > 0) {
      const double part = std::min(samples, tick - into_);
      active_ += part * active;
      into_ += part;
      samples -= part;
      if (into_ < tick) break;
      gain_ = agc_(static_cast<float>(active_));
      into_ = active_ = 0;
    }
    return *this;
  }

  SlowAgc<float> agc_;
  double into_ = 0, active_ = 0;
  float gain_ = 1;
};

const std::vector<double> starts{0, 0.3, 2.5, 7, 9.99};

TEST(SlowAgc, ShortBurstsWithLongGapsAreNotCharged) {
  for (const double start : starts) {
    Timeline t(start);
    for (int i = 0; i < 100; ++i) t.lit(799).dark(311);
    EXPECT_EQ(t.gain(), 0) << start;
  }
}

// Wherever it falls on the grid of ticks, a long burst of N samples is charged N, no tick less.
TEST(SlowAgc, ALongBurstIsChargedWhole) {
  for (const double start : starts)
    for (const double burst : {801., 980., 1234.5})
      EXPECT_NEAR(Timeline(start).lit(burst).dark(tick).gain(), 0.01 * burst, 0.004 * tick + 1e-3)
          << start << " " << burst;
}

TEST(SlowAgc, AGapEndsABurstFromItsLengthOn) {
  for (const double start : starts) {
    EXPECT_GT(Timeline(start).lit(500).dark(299).lit(500).dark(tick).gain(), 9) << start;
    EXPECT_EQ(Timeline(start).lit(500).dark(301).lit(500).dark(tick).gain(), 0) << start;
  }
}

TEST(SlowAgc, DarkLetsItDownToRestAndNoFurther) {
  Timeline t(0);
  t.lit(2000);
  EXPECT_NEAR(t.gain(), 20, 1e-3);
  EXPECT_NEAR(t.dark(1000).gain(), 16, 1e-3);
  EXPECT_EQ(t.dark(10000).gain(), 0);
}

TEST(SlowAgc, SparesTheFirstCyclesOfALongBurst) {
  SlowAgcDesign sparing = design;
  sparing.free = 200;
  EXPECT_NEAR(Timeline(0, sparing).lit(1000).gain(), 8, 1e-3);
  EXPECT_EQ(Timeline(0, sparing).lit(790).gain(), 0);
}

// AGC5, AGC6: one gap for bursts of any length (Vishay 82836 Fig. 8).
TEST(SlowAgc, HoldsItsGainUntilTheGapIsLongEnough) {
  SlowAgcDesign holding = design;
  holding.hold = 2000;
  for (const double start : starts) {
    EXPECT_NEAR(Timeline(start, holding).lit(1000).dark(1990).gain(), 10, 0.05) << start;
    EXPECT_NEAR(Timeline(start, holding).lit(1000).dark(3000).gain(), 6, 0.05) << start;
    Timeline train(start, holding);
    for (int i = 0; i < 5; ++i) train.lit(1000).dark(1990);
    EXPECT_NEAR(train.gain(), 50, 0.1) << start;
  }
}

TEST(SlowAgc, StopsAtItsRange) { EXPECT_NEAR(Timeline(0).lit(50000).gain(), 60, 1e-3); }

// Vishay 82459 Fig. 8: one duty for all long bursts, release / (attack + release) = .2857 here.
TEST(SlowAgc, LongBurstsBalanceAtOneDutyWhateverTheirLength) {
  for (const double burst : {850., 980., 3000.})
    for (const double start : starts) {
      Timeline below(start), above(start);
      for (int i = 0; i < 100; ++i) {
        below.lit(burst).dark(burst / 0.283 - burst);
        above.lit(burst).dark(burst / 0.289 - burst);
      }
      EXPECT_EQ(below.gain(), 0) << start;
      EXPECT_GT(above.gain(), 0.5) << start;
    }
}

/// An AGC with the gain up and its last activity some ticks ago.
SlowAgc<float> charged(const SlowAgcDesign& d) {
  SlowAgc<float> agc(d);
  for (int i = 0; i < 400; ++i) agc(tick);
  for (int i = 0; i < 7; ++i) agc(0);
  return agc;
}

TEST(SlowAgc, RestsAsItTicksInTheDark) {
  SlowAgcDesign held = design;
  held.hold = 900;
  for (const SlowAgcDesign& d : {design, held})
    for (const int ticks : {1, 20, 200, 5000}) {
      SlowAgc<float> ticked = charged(d), rested = charged(d);
      float gain = 1;
      for (int i = 0; i < ticks; ++i) gain = ticked(0);
      EXPECT_NEAR(in_db(rested.rest(static_cast<float>(ticks * tick), 0)), in_db(gain), 2e-3);
      for (int i = 0; i < 200; ++i) gain = ticked(tick);
      for (int i = 0; i < 199; ++i) rested(tick);
      EXPECT_NEAR(in_db(rested(tick)), in_db(gain), 2e-3) << "bursts and gaps are remembered";
    }
}

TEST(SlowAgc, RestsNoLowerThanItIsTold) {
  SlowAgc<float> agc = charged(design);
  EXPECT_NEAR(in_db(agc.rest(1e6f, 3)), 3, 1e-3);
  EXPECT_NEAR(in_db(agc.rest(1e6f, 5)), 3, 1e-3);
  EXPECT_NEAR(in_db(agc.rest(1e6f, 0)), 0, 1e-3);
}

TEST(SlowAgc, LooksAheadAtItsSlope) {
  SlowAgc<float> agc(design);
  for (int i = 0; i < 400; ++i) agc(tick);
  const double now = in_db(agc.ahead(0)), half = in_db(agc.ahead(0.5f));
  EXPECT_NEAR(half - now, 0.5 * tick * static_cast<double>(design.attack), 1e-4);
  EXPECT_NEAR(in_db(agc(tick)), 2 * half - now, 1e-4);
}

}  // namespace
}  // namespace channel
