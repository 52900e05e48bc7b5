#include "channel/light_meter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "bpw34.hpp"

namespace channel {
namespace {

LightMeter meter_at(double sample_rate_hz, double aperture = 1) {
  return {.photodiode = bpw34, .sample_rate_hz = sample_rate_hz, .aperture = aperture};
}

MeteredLight light_of(double signal_w_per_m2, double ambient_w_per_m2 = 0) {
  return {.signal = dsp::WattsPerSquareMetre(signal_w_per_m2),
          .ambient = dsp::WattsPerSquareMetre(ambient_w_per_m2)};
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// TSAL6200 at 100 mA gives 72.3 mW/m2 at 1 m (Vishay 81010 rev 2.4 Fig. 5): .36 uA in a BPW34.
TEST(LightMeter, SeesTheLedAtAMetreAsVolts) {
  const MeterWindow window = steady_window(59, 0);  // at 1 MS/s not one cycle too many
  LightMeter meter = meter_at(1e6);
  meter.photodiode.dark_current_na = 0;
  MeteredLight light = light_of(0.0723);
  light.duty = 1;
  for (const double v : noiseless_volts(meter, light, window)) EXPECT_NEAR(v, 0.3615, 1e-4);
}

TEST(LightMeter, MeanIsTheDutyWhateverTheRates) {
  const LightMeter meter = meter_at(59e3 * 7.3);
  const auto v = noiseless_volts(meter, light_of(0.1, 0.2), steady_window(730, 0.1));  // 100 cycles
  EXPECT_NEAR(mean(v), 0.6667 * 7.5 * (0.2 + 0.1 / 2) + 2e-3, 1e-12);
}

TEST(LightMeter, DarkWindowsHaveAmbientAndDarkCurrent) {
  for (const double v : noiseless_volts(meter_at(2e5), light_of(9, 0.2), {.samples = 4}))
    EXPECT_NEAR(v, 0.6667 * 7.5 * 0.2 + 2e-3, 1e-12);
}

TEST(LightMeter, BurstsBeginAndEndInsideOfSamples) {
  MeteredLight light = light_of(1);
  light.duty = 1;
  LightMeter meter = meter_at(2e5, 0.5);
  meter.photodiode.dark_current_na = 0;
  // Apertures: [0, .5), [1, 1.5), [2, 2.5), [3, 3.5); light: [.25, 1.1), [1.4, 2.25).
  const auto v = noiseless_volts(meter, light, {4, 0.3, {{0.25, 1.1}, {1.4, 2.25}}});
  const double full = 0.6667 * 7.5;
  const double expected[] = {0.5, 0.4, 0.5, 0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(v[i], expected[i] * full, 1e-12) << i;
}

/// Amplitude of a frequency in the samples, as a share of the carrier's peak.
double amplitude_at(const LightMeter& meter, double hz) {
  constexpr std::size_t n = 20000;
  const auto v = noiseless_volts(meter, light_of(1), steady_window(n, 0));
  double c = 0, s = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = 2 * std::numbers::pi * hz / meter.sample_rate_hz * static_cast<double>(i);
    c += v[i] * std::cos(w);
    s += v[i] * std::sin(w);
  }
  return std::hypot(c, s) * 2 / n / (0.6667 * 7.5);
}

/// Of the harmonic k of a square wave of duty 1/2, averaged over the aperture.
double seen(int k, double aperture_s) {
  const double x = std::numbers::pi * k * 59e3 * aperture_s;
  return std::abs(2 / (std::numbers::pi * k) * std::sin(x) / x);
}

// 59 kHz at 20.011 kS/s is 1.033 kHz, its third harmonic 3.099 kHz. The rate has no factor
// in common with the carrier, so that each harmonic has an alias of its own.
TEST(LightMeter, SlowAdcSeesTheCarrierAliased) {
  constexpr double rate = 20011;
  for (const double aperture : {0.01, 0.2, 1.0}) {
    const LightMeter meter = meter_at(rate, aperture);
    EXPECT_NEAR(amplitude_at(meter, 3 * rate - 59e3), seen(1, aperture / rate), 5e-4) << aperture;
    EXPECT_NEAR(amplitude_at(meter, 9 * rate - 177e3), seen(3, aperture / rate), 5e-4) << aperture;
    EXPECT_NEAR(amplitude_at(meter, 2e3), 0, 5e-4) << aperture;
  }
}

TEST(LightMeter, NoiseIsShotAndThermal) {
  // 2 q 1 uA = 3.204e-25, 4 k T / 1 Mohm = 1.647e-26 A2/Hz; 5 us: 100 kHz.
  const double expected = 1e6 * std::sqrt((3.2044e-25 + 1.6466e-26) * 1e5);
  EXPECT_NEAR(noise_volts(meter_at(2e5), 1.0), expected, expected * 1e-4);
  EXPECT_NEAR(noise_volts(meter_at(2e5, 0.25), 1.0), 2 * expected, expected * 1e-4);
}

TEST(LightMeter, ConvertsToTheNearestStepAndClips) {
  LightMeter meter = meter_at(2e5);
  meter.adc_bits = 3;
  meter.full_scale_v = 4;
  EXPECT_EQ(adc_step(meter), 0.5);
  EXPECT_EQ(converted(meter, 1.2), 1.0);
  EXPECT_EQ(converted(meter, 1.3), 1.5);
  EXPECT_EQ(converted(meter, -1), 0);
  EXPECT_EQ(converted(meter, 4), 3.5);
  EXPECT_TRUE(is_clipped(meter, converted(meter, 3.3)));
  EXPECT_TRUE(is_clipped(meter, converted(meter, 0.2)));
  EXPECT_FALSE(is_clipped(meter, converted(meter, 3.2)));
}

}  // namespace
}  // namespace channel
