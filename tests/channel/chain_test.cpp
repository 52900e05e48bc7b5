// The chain from wire to wire: trials at once are each the trial alone, to the last bit; a
// clear link is the identity plus a delay; noise is what it should be behind the band-pass.
#include "channel/chain.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "channel/data_sheet_bench.hpp"
#include "channel/noise.hpp"
#include "gtest/gtest.h"

namespace channel {
namespace {

/// A random wire of bits of 1/600 s that starts and ends dark.
dsp::LogicTrace random_wire(std::mt19937& random, int bits) {
  dsp::LogicTrace wire(true);
  std::uniform_real_distribution<double> u(0, 1);
  const double start = 5e-3 + u(random) * 5e-3;
  for (int i = 0; i < bits; ++i) wire.set_at(dsp::Seconds(start + i / 600.0), random() % 2 == 0);
  wire.set_at(dsp::Seconds(start + bits / 600.0), true);
  wire.observe_until(dsp::Seconds(start + bits / 600.0 + 5e-3 * u(random) + 2e-3));
  return wire;
}

ChainDesign noisy_design(double e_mw_per_m2) {
  return design_chain(ModuleData{},
                      {.signal = dsp::WattsPerSquareMetre(e_mw_per_m2 * 1e-3),
                       .ambient = dsp::WattsPerSquareMetre(5),
                       .carrier = dsp::Hertz(59e3)},
                      dsp::Hertz(1e6));
}

// Nineteen are more than any kernel has lanes for: sixteen and three, or eight, eight and three.
TEST(ChainDeterminism, ManyTogetherAreEachAlone) {
  constexpr std::uint32_t trials = 19;
  std::mt19937 random(1);
  for (const double e : {0.5, 1.0, 30.0}) {  // around the threshold, so that noise decides
    std::vector<dsp::LogicTrace> wires;
    for (std::uint32_t i = 0; i < trials; ++i)
      wires.push_back(random_wire(random, 40 + 10 * static_cast<int>(i % 8)));
    std::vector<ChainInput> inputs;
    for (std::uint32_t i = 0; i < trials; ++i)
      inputs.push_back({&wires[i], i * 7919u << 16, {i, 1, 2, 3}});
    const ChainDesign design = noisy_design(e);
    const auto together = propagate(design, inputs);
    ASSERT_EQ(together.size(), trials);
    for (std::size_t i = 0; i < trials; ++i) {
      EXPECT_EQ(together[i], propagate_alone(design, inputs[i])) << e << " lane " << i;
    }
    for (const InstructionSet set : {InstructionSet::v3, InstructionSet::baseline})
      EXPECT_EQ(propagate(design, inputs, nullptr, set), together) << e;
    const std::span<const ChainInput> all(inputs);
    EXPECT_EQ(propagate(design, all.subspan(2, 3))[1], together[3]) << "neighbours must not matter";
  }
}

TEST(ChainDeterminism, RecordingChangesNothingAndHasEverySample) {
  std::mt19937 random(2);
  const dsp::LogicTrace wire = random_wire(random, 60);
  const ChainInput input{&wire, 99, {1, 2, 3, 4}};
  Recording taps;
  const ChainDesign design = noisy_design(1);
  EXPECT_EQ(propagate_alone(design, input, &taps), propagate_alone(design, input));
  const auto samples = static_cast<std::size_t>(std::ceil(wire.end().value * 1e6));
  for (const auto* tap :
       {&taps.irradiance, &taps.band_pass, &taps.threshold, &taps.integrator, &taps.agc_gain})
    EXPECT_EQ(tap->size(), samples);
}

// The pin changes at the end of the very sample that fills or empties the integrator.
TEST(ChainDeterminism, EdgesAreAtTheSamplesThatMakeThem) {
  std::mt19937 random(6);
  const dsp::LogicTrace wire = random_wire(random, 60);
  Recording taps;
  const dsp::LogicTrace pin = propagate_alone(noisy_design(30), {&wire, 1, {1, 2, 3, 4}}, &taps);
  const float top = *std::max_element(taps.integrator.begin(), taps.integrator.end());
  dsp::LogicTrace expected(true, wire.end());
  for (std::size_t i = 0; i < taps.integrator.size(); ++i) {
    const dsp::Seconds end(static_cast<double>(i + 1) / 1e6);
    if (taps.integrator[i] == top) expected.set_at(end, false);
    if (taps.integrator[i] == 0) expected.set_at(end, true);
  }
  EXPECT_GT(pin.edges().size(), 10u);
  EXPECT_EQ(pin, expected);
}

// A strong signal without noise and without AGC: every bit of any message arrives, late by the
// nominal delay give or take the pulse-width window.
TEST(Chain, ClearLinkIsTheIdentityPlusADelay) {
  std::mt19937 random(4);
  Bench bench;
  bench.module.agc_attack_db_per_ms = 0;
  const LightSettings light{.signal = dsp::WattsPerSquareMetre(5e-3),
                            .ambient = dsp::WattsPerSquareMetre(0),
                            .carrier = dsp::Hertz(59e3),
                            .noise_scale = 0};
  const ChainDesign design = design_chain(bench.module, light, dsp::Hertz(1e6));
  for (int round = 0; round < 10; ++round) {
    const dsp::LogicTrace wire = random_wire(random, 200);
    const ChainInput input{&wire, static_cast<std::uint32_t>(random()), {1, 2, 3, 4}};
    const dsp::LogicTrace pin = propagate(design, {&input, 1}).front();
    ASSERT_EQ(pin.edges().size(), wire.edges().size());
    for (std::size_t i = 0; i < pin.edges().size(); ++i) {
      const dsp::Seconds late = pin.edges()[i] - wire.edges()[i] - nominal_delay(bench.module);
      EXPECT_LT(std::fabs(late.value) * 56e3, 4) << i;  // cycles
    }
  }
}

/// Noise power behind front end and band-pass over that of the density in (pi/2) f0/Q: the front
/// end's pole, 1 at f0, takes more of the upper skirt than it adds to the lower one.
double front_end_share(const ModuleData& module) {
  double sum = 0;
  constexpr double step = 10;
  for (double f = step; f < 500e3; f += step) {
    const double ratio = f / module.centre_hz;
    const double resonator = 1 / (1 + std::pow(module.q * (ratio - 1 / ratio), 2));
    const double pole = (1 + std::pow(module.centre_hz / module.front_end_hz, 2)) /
                        (1 + std::pow(f / module.front_end_hz, 2));
    sum += resonator * pole * step;
  }
  return sum / noise_bandwidth(module).value;
}

// Noise alone behind the band-pass has the power of its density in the noise bandwidth.
TEST(Chain, NoiseBehindTheBandPass) {
  const ModuleData module;
  const auto ambient = dsp::WattsPerSquareMetre(10);
  const ChainDesign design = design_chain(
      module, {.signal = {}, .ambient = ambient, .carrier = dsp::Hertz(59e3)}, dsp::Hertz(1e6));
  dsp::LogicTrace dark(true);
  dark.observe_until(dsp::Seconds(4));
  Recording taps;
  propagate_alone(design, {&dark, 0, {5, 6, 7, 8}}, &taps);
  double power = 0;
  for (const float u : taps.band_pass) power += static_cast<double>(u) * static_cast<double>(u);
  const double rms = std::sqrt(power / static_cast<double>(taps.band_pass.size()));
  const double current = rms * 1e-3 * module.responsivity_a_per_w * module.aperture_mm2 * 1e-6;
  const double density = noise_density(module, photocurrent(module, ambient));
  const double share = front_end_share(module);
  EXPECT_GT(share, 0.95);
  EXPECT_NEAR(current / std::sqrt(density * noise_bandwidth(module).value * share), 1, 0.01);
}

// The noise is the ambient light's in the dark, and grows with the signal's own in a burst.
TEST(Chain, SignalAddsItsShotNoise) {
  const auto design = noisy_design(1000);
  EXPECT_GT(design.noise_lit, design.noise_dark * 1.02f);
  EXPECT_EQ(noisy_design(0).noise_lit, noisy_design(0).noise_dark);
}

/// Irradiance at which a bit of detuned light is reported for 90 cycles, without noise and gain
/// control, the carrier beginning at `phase`.
double threshold_at(double sample_rate_hz, std::uint32_t phase) {
  const BurstTrain bit{.carrier_hz = 59e3, .burst_s = 98 / 59e3, .bursts = 1};
  Bench bench;
  bench.sample_rate_hz = sample_rate_hz;
  bench.module.agc_attack_db_per_ms = 0;
  const dsp::LogicTrace drive = drive_of(bit);
  const ChainInput input{&drive, phase, {1, 2, 3, 4}};
  double low = 0.05, high = 0.5;
  while (high / low > 1.0001) {
    const double middle = std::sqrt(low * high);
    const auto pulses = pulses_of(propagate_alone(design_of(bench, bit, middle), input));
    const bool reported = pulses.size() == 1 && pulses.front().width() > 90 / 59e3;
    (reported ? high : low) = middle;
  }
  return high;
}

/// How far apart the thresholds at thirteen phases are, as a ratio. A prime number of them: at any
/// rate they are at different places between two samples.
double spread_over_phases(double sample_rate_hz) {
  std::vector<double> thresholds;
  for (std::uint32_t i = 0; i < 13; ++i)
    thresholds.push_back(threshold_at(sample_rate_hz, i * (0xFFFFFFFFu / 13)));
  const auto [low, high] = std::ranges::minmax(thresholds);
  return high / low;
}

// Where the carrier meets the sample grid must not count (trap: 8 samples a cycle bend a
// rectifier). At the default rate it does not; at a whole multiple of the carrier, such as 472
// kS/s, all cycles of a bit meet the same samples, so it does, and such points are flagged
// (sim/link/validity); sixteen samples a cycle are enough even so.
TEST(Chain, CarrierPhaseOnTheGridDoesNotMoveTheThreshold) {
  EXPECT_LT(spread_over_phases(600e3), 1.002);
  EXPECT_NEAR(spread_over_phases(8 * 59e3), 1.07, 0.005);
  EXPECT_NEAR(spread_over_phases(10 * 59e3), 1.05, 0.005);
  EXPECT_NEAR(spread_over_phases(16 * 59e3), 1.02, 0.005);
}

TEST(Chain, SampleRateDoesNotMoveTheThreshold) {
  const BurstTrain train{.carrier_hz = 59e3, .burst_s = 98 / 59e3, .bursts = 4};
  std::vector<double> thresholds;
  for (const double rate : {59e3 * 16, 59e3 * 17, 600e3, 1e6, 1.0371e6}) {
    Bench bench;
    bench.sample_rate_hz = rate;
    thresholds.push_back(measured_emin(bench, train));
  }
  const auto [low, high] = std::ranges::minmax(thresholds);
  EXPECT_LT(high / low, 1.02);
}

}  // namespace
}  // namespace channel
