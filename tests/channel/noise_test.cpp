// Noise by the numbers that data sheets and textbooks print.
#include "channel/noise.hpp"

#include <cmath>

#include "gtest/gtest.h"

namespace channel {
namespace {

// 2 q I and 4 k T / R: 1 uA of shot noise .566 pA/sqrt(Hz), 43 uA 3.71; 1 MOhm at 300 K .129.
TEST(Noise, TextbookDensities) {
  ModuleData quiet;
  quiet.temperature_k = 0;
  EXPECT_NEAR(std::sqrt(noise_density(quiet, dsp::Amperes(1e-6))), 0.566e-12, 0.001e-12);
  EXPECT_NEAR(std::sqrt(noise_density(quiet, dsp::Amperes(43e-6))), 3.71e-12, 0.01e-12);
  EXPECT_NEAR(std::sqrt(noise_density(ModuleData{}, dsp::Amperes(0))), 0.129e-12, 0.001e-12);
}

// Likewise: 10 W/m2 on 6.7 mm2 is about 43 uA, 348 pA rms in the 8.80 kHz of a 56 kHz part.
TEST(Noise, ShotNoiseOfDaylight) {
  const ModuleData module;
  const auto current = photocurrent(module, dsp::WattsPerSquareMetre(10));
  EXPECT_NEAR(current.value, 43.5e-6, 0.1e-6);
  EXPECT_NEAR(noise_bandwidth(module).value, 8796, 1);
  const double rms = std::sqrt(noise_density(module, current) * noise_bandwidth(module).value);
  EXPECT_NEAR(rms, 350e-12, 3e-12);
}

// R21: shot noise of 1 uA in a 38 kHz part, 5.97 kHz: 43.7 pA rms; T2525 minimum signal 520 pA pp
// square, 234 pA rms fundamental: 14.6 dB.
TEST(Noise, R21_NoiseAndSignalAtThreshold) {
  ModuleData module;
  module.centre_hz = 38e3;
  module.temperature_k = 0;
  const double rms =
      std::sqrt(noise_density(module, dsp::Amperes(1e-6)) * noise_bandwidth(module).value);
  EXPECT_NEAR(rms, 43.7e-12, 0.02 * 43.7e-12);
  const double signal = 520e-12 * 2 / M_PI / std::sqrt(2.0);
  EXPECT_NEAR(signal, 234e-12, 1e-12);
  EXPECT_NEAR(20 * std::log10(signal / rms), 14.6, 0.5);
}

TEST(Noise, SampleDeviationIsTheDensityOverTheNyquistBand) {
  const ModuleData module;
  const double density = noise_density(module, dsp::Amperes(1e-6));
  const double at_1 = sample_deviation_mw_per_m2(module, density, dsp::Hertz(1e6));
  const double at_4 = sample_deviation_mw_per_m2(module, density, dsp::Hertz(4e6));
  EXPECT_NEAR(at_4 / at_1, 2, 1e-12);
  const double amperes = at_1 * 1e-3 * module.responsivity_a_per_w * module.aperture_mm2 * 1e-6;
  EXPECT_NEAR(amperes * amperes / 0.5e6, density, 1e-12 * density);
}

}  // namespace
}  // namespace channel
