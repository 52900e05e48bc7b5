#include "dsp/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>
#include <thread>

#include "dsp/philox.hpp"

namespace dsp {
namespace {

using std::numbers::pi;

constexpr Hertz rate(1e6);

std::vector<float> white_noise(std::size_t n, double sigma) {  // Box and Muller's method
  const RandomAddress address{.seed = 42};
  std::vector<float> noise(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto index = static_cast<std::uint32_t>(2 * i);
    const double radius = std::sqrt(-2 * std::log(1 - address.uniform(index)));
    noise[i] = static_cast<float>(sigma * radius * std::cos(2 * pi * address.uniform(index + 1)));
  }
  return noise;
}

std::vector<float> tone(std::size_t n, double amplitude, double f, double phase = 0.3,
                        double offset = 0) {
  std::vector<float> samples(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * pi * f * static_cast<double>(i) / rate.value + phase;
    samples[i] = static_cast<float>(offset + amplitude * std::cos(angle));
  }
  return samples;
}

double mean_square(std::span<const float> samples) {
  double sum = 0;
  for (double x : samples) sum += x * x;
  return sum / static_cast<double>(samples.size());
}

double all_power(const Spectrum& s) { return band_power(s, Hertz(0), rate); }

TEST(Welch, ParsevalHoldsForOneSegment) {  // the bins hold the windowed signal's power, exactly
  for (const std::size_t n : std::initializer_list<std::size_t>{2, 3, 64, 255, 1000}) {
    const std::vector<float> x = white_noise(n, 1);
    double windowed = 0, energy = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double w =
          0.5 - 0.5 * std::cos(2 * pi * static_cast<double>(i) / static_cast<double>(n));
      windowed += std::pow(w * x[i], 2);
      energy += w * w;
    }
    const double expected = windowed / energy;
    EXPECT_NEAR(all_power(welch(x, rate, n, Mean::keep)), expected, 1e-12 + 1e-12 * expected) << n;
  }
}

TEST(Welch, ParsevalHoldsForWhiteNoise) {
  const std::vector<float> x = white_noise(200000, 3);
  EXPECT_NEAR(all_power(welch(x, rate, 1024)), mean_square(x), .01 * mean_square(x));
}

TEST(Welch, WhiteNoiseHasTheSameDensityEverywhere) {  // sigma^2 / (rate / 2)
  const double sigma = 2, expected = sigma * sigma / (rate.value / 2);
  const Spectrum s = welch(white_noise(400000, sigma), rate, 256, Mean::keep);
  for (std::size_t k = 1; k + 1 < s.density.size(); ++k) {
    EXPECT_NEAR(s.density[k], expected, .15 * expected) << k;  // 6 standard deviations
  }
  EXPECT_NEAR(s.density.front(), expected / 2, .15 * expected);
  EXPECT_NEAR(s.density.back(), expected / 2, .15 * expected);
}

TEST(Welch, ASineHasItsPowerInItsBand) {
  const double f = 59000;
  for (double amplitude : {1.0, 0.01}) {
    const Spectrum s = welch(tone(50000, amplitude, f), rate, 2000);
    const double power = amplitude * amplitude / 2;
    EXPECT_NEAR(band_power(s, Hertz(f - 2000), Hertz(f + 2000)), power, 1e-3 * power);
    EXPECT_LT(band_power(s, Hertz(0), Hertz(f - 5000)), 1e-5 * power);
    EXPECT_LT(band_power(s, Hertz(f + 5000), rate), 1e-5 * power);
  }
}

TEST(Welch, FrequenciesRunFromZeroToHalfTheRate) {
  const Spectrum even = welch(white_noise(100, 1), rate, 8);
  ASSERT_EQ(even.frequency_hz.size(), 5u);
  EXPECT_EQ(even.frequency_hz[0], 0);
  EXPECT_EQ(even.frequency_hz[1], 125e3);
  EXPECT_EQ(even.frequency_hz[4], 500e3);
  const Spectrum odd = welch(white_noise(100, 1), rate, 5);
  ASSERT_EQ(odd.frequency_hz.size(), 3u);
  EXPECT_DOUBLE_EQ(odd.frequency_hz[2], 400e3);
}

TEST(Welch, RemovesOrKeepsTheMean) {
  const std::vector<float> x = tone(20000, 1, 59000, 0, 10);
  EXPECT_NEAR(all_power(welch(x, rate, 2000, Mean::keep)), 100.5, .01);
  EXPECT_NEAR(all_power(welch(x, rate, 2000, Mean::remove)), .5, .001);
  EXPECT_NEAR(all_power(welch(x, rate, 2000)), .5, .001);
}

TEST(Welch, AveragesHalfOverlappingSegments) {
  const std::vector<float> x = white_noise(150, 1);
  const Spectrum all = welch(x, rate, 100);
  const Spectrum first = welch(std::span(x).first(100), rate, 100);
  const Spectrum second = welch(std::span(x).last(100), rate, 100);
  for (std::size_t k = 0; k < all.density.size(); ++k) {
    EXPECT_NEAR(all.density[k], (first.density[k] + second.density[k]) / 2, 1e-18);
  }
}

TEST(Welch, ALongSegmentIsShortenedToTheData) {
  const std::vector<float> x = white_noise(300, 1);
  const Spectrum s = welch(x, rate, 4096);
  EXPECT_EQ(s.frequency_hz.size(), 151u);
  EXPECT_EQ(s.density, welch(x, rate, 300).density);
}

TEST(Welch, DensityDoesNotDependOnTheSampleRateAlone) {  // same samples, half the rate: twice
  const std::vector<float> x = white_noise(1000, 1);
  const Spectrum full = welch(x, rate, 100), half = welch(x, Hertz(5e5), 100);
  for (std::size_t k = 0; k < full.density.size(); ++k) {
    EXPECT_DOUBLE_EQ(half.density[k], 2 * full.density[k]);
  }
}

TEST(Welch, ThreadsGetTheSameAnswer) {
  const std::vector<float> x = white_noise(20000, 1);
  std::vector<Spectrum> found(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i) {
    threads.emplace_back([&, i] { found[i] = welch(x, rate, 500 + 10 * (i % 2)); });
  }
  for (std::thread& t : threads) t.join();
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].density, welch(x, rate, 500 + 10 * (i % 2)).density);
  }
}

TEST(LineAmplitude, FindsTheAmplitudeWhateverThePhase) {
  for (double phase : {0.0, 1.0, 2.5, -2.0}) {
    EXPECT_NEAR(line_amplitude(tone(10000, .7, 59000, phase), rate, Hertz(59000)), .7, 1e-6);
  }
}

TEST(LineAmplitude, SeesNothingOfOtherWholePeriods) {
  const std::vector<float> x = tone(10000, .7, 59000, .3, 5);
  EXPECT_NEAR(line_amplitude(x, rate, Hertz(118000)), 0, 1e-6);
  EXPECT_NEAR(line_amplitude(x, rate, Hertz(58900)), 0, 1e-6);
}

TEST(LineAmplitude, EdgesOfTheBandCountOnce) {
  EXPECT_NEAR(line_amplitude(tone(1000, 0, 0, 0, -3), rate, Hertz(0)), 3, 1e-9);
  EXPECT_NEAR(line_amplitude(tone(1000, 2, 5e5, 0), rate, Hertz(5e5)), 2, 1e-6);
}

TEST(LineAmplitude, HarmonicsOfASquareWave) {  // 0/1 at duty D: (2 / (k pi)) |sin(pi k D)|
  constexpr int period = 1000, on = 250;
  std::vector<float> x(20 * period);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = i % period < on ? 1.f : 0.f;
  for (int k = 1; k <= 5; ++k) {
    const double expected = 2 / (k * pi) * std::abs(std::sin(pi * k * .25));
    EXPECT_NEAR(line_amplitude(x, rate, Hertz(k * rate.value / period)), expected, 1e-4) << k;
  }
}

TEST(BandPower, AddsUpOverNeighbouringBands) {
  const Spectrum s = welch(white_noise(5000, 1), rate, 100);  // bins 10 kHz apart
  const double low = band_power(s, Hertz(0), Hertz(105e3));
  const double high = band_power(s, Hertz(105e3), Hertz(500e3));
  EXPECT_NEAR(low + high, all_power(s), 1e-12);
  EXPECT_GT(low, 0);
}

TEST(BandPower, TakesBinsByTheirCentres) {
  const Spectrum s{{0, 10, 20, 30}, {1, 2, 4, 8}};
  EXPECT_DOUBLE_EQ(band_power(s, Hertz(10), Hertz(20)), 60);
  EXPECT_DOUBLE_EQ(band_power(s, Hertz(9.9), Hertz(10.1)), 20);
  EXPECT_EQ(band_power(s, Hertz(11), Hertz(19)), 0);
  EXPECT_EQ(band_power(s, Hertz(20), Hertz(10)), 0);
  EXPECT_EQ(band_power(s, Hertz(31), Hertz(99)), 0);
}

#ifndef NDEBUG
TEST(SpectrumDeathTest, WantsSamplesAndFrequenciesInTheBand) {
  const std::vector<float> x = white_noise(10, 1);
  EXPECT_DEATH(welch({}, rate, 8), "n >= 2");
  EXPECT_DEATH(welch(x, rate, 1), "n >= 2");
  EXPECT_DEATH(welch(x, Hertz(0), 8), "sample_rate");
  EXPECT_DEATH(line_amplitude({}, rate, Hertz(1)), "empty");
  EXPECT_DEATH(line_amplitude(x, rate, Hertz(6e5)), "sample_rate");
  EXPECT_DEATH(band_power({}, Hertz(0), Hertz(1)), "size");
}
#endif

}  // namespace
}  // namespace dsp
