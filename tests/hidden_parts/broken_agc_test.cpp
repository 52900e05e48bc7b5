// How each broken AGC breaks the rule. That the one that breaks nothing is the channel's is tested
// with the recordings.
#include "broken_agc.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hidden {
namespace {

constexpr int samples_a_cycle = 10;
constexpr double cycles_a_ms = 56;

/// Attack 0.3 dB/ms, release 0.1 dB/ms, long bursts beyond 80 cycles.
channel::ModuleData usual_module() {
  channel::ModuleData module;
  module.agc_attack_db_per_ms = 0.3;
  module.agc_max_duty = 0.25;
  module.agc_long_burst_cycles = 80;
  return module;
}

/// A broken AGC, lit and dark for so many cycles; the decibels then.
class AgcBench {
 public:
  explicit AgcBench(Broken broken, const channel::ModuleData& module = usual_module())
      : agc_(channel::design_slow_agc(module, rate), broken_rule(broken, module, rate)) {}

  double lit(double cycles) { return pass(cycles, samples_a_cycle); }
  double dark(double cycles) { return pass(cycles, 0); }

 private:
  static constexpr dsp::Hertz rate{56e3 * samples_a_cycle};

  double pass(double cycles, float active) {
    float gain = 1;
    for (long i = std::lround(cycles); i > 0; --i) gain = agc_(active);
    return 20 * std::log10(static_cast<double>(gain));
  }

  BrokenAgc<float> agc_;
};

TEST(BrokenAgc, AttackDoublesFrom20DbOn) {
  AgcBench agc(Broken::steep_attack);
  EXPECT_NEAR(agc.lit(60 * cycles_a_ms), 18, 0.02);
  EXPECT_NEAR(agc.lit(20 * cycles_a_ms), 20 + 8, 0.02);
}

TEST(BrokenAgc, ReleaseIsThreeTimesAsFastFor10Ms) {
  AgcBench agc(Broken::two_releases);
  EXPECT_NEAR(agc.lit(100 * cycles_a_ms), 30, 0.02);
  EXPECT_NEAR(agc.dark(5 * cycles_a_ms), 30 - 1.5, 0.02);
  EXPECT_NEAR(agc.dark(15 * cycles_a_ms), 30 - 3 - 1, 0.02);
}

TEST(BrokenAgc, ChargesAFifthOfShortBursts) {
  AgcBench shorter(Broken::charged_short_bursts), longer(Broken::charged_short_bursts);
  EXPECT_NEAR(shorter.lit(60), 0.2 * 0.3 * 60 / cycles_a_ms, 0.001);
  EXPECT_NEAR(longer.lit(120), 0.3 * 120 / cycles_a_ms, 0.001);
}

TEST(BrokenAgc, ToleratesHalfTheDutyOfBurstsBeyond300Cycles) {
  for (const double burst : {200.0, 400.0}) {
    const double duty = burst < 300 ? 0.25 : 0.125;
    AgcBench agc(Broken::harsh_long_bursts);
    const double start = agc.lit(3000);
    double end = 0;
    agc.dark(400);
    for (int i = 0; i < 10; ++i) {
      agc.lit(burst);
      end = agc.dark(burst / duty - burst);
    }
    EXPECT_NEAR(end, start - 0.1 * 400 / cycles_a_ms, 0.02);
  }
}

TEST(BrokenAgc, GainFallsLinearlyAndBy20DbInTheSameTime) {
  AgcBench agc(Broken::linear_attack);
  EXPECT_NEAR(agc.lit(20 / 0.3 / 2 * cycles_a_ms), -20 * std::log10(0.55), 0.02);
  EXPECT_NEAR(agc.lit(20 / 0.3 / 2 * cycles_a_ms), 20, 0.05);
  EXPECT_NEAR(agc.lit(20 / 0.3 * cycles_a_ms), usual_module().agc_range_db, 0.001);
}

}  // namespace
}  // namespace hidden
