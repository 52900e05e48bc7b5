// The baseband of traces: the carrier's complex amplitude, and nothing else.
#include "sim/trace/baseband.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sim {
namespace {

using dsp::Hertz;

struct Tone {
  double hertz, amplitude = 1, phase = 0;
};

std::vector<float> samples_of(const Tone& tone, double rate) {
  std::vector<float> samples;
  for (int i = 0; i < 40'000; ++i)
    samples.push_back(static_cast<float>(
        tone.amplitude * std::cos(2 * std::numbers::pi * tone.hertz * i / rate + tone.phase)));
  return samples;
}

/// Where the filter sees samples alone.
std::span<const std::complex<float>> inside(const Baseband& baseband) {
  return std::span(baseband.samples).subspan(10, baseband.samples.size() - 20);
}

/// The lowest whole fraction of at least 50 kHz.
double new_rate(double rate) { return rate / std::floor(rate / 50e3); }

constexpr double rates[] = {250e3, 617e3, 1e6};

TEST(Baseband, IsTheCarriersComplexAmplitude) {
  for (const double rate : rates) {
    const Baseband baseband =
        baseband_of(samples_of({58.9e3, 3, 0.7}, rate), Hertz(rate), Hertz(58.9e3));
    for (const auto& sample : inside(baseband)) {
      EXPECT_NEAR(std::abs(sample), 3, 0.002);
      EXPECT_NEAR(std::arg(sample), 0.7, 0.001);
    }
  }
}

TEST(Baseband, KeepsRateAndPhaseOfWhatIsNearTheCarrier) {
  for (const double rate : rates) {
    const Baseband baseband =
        baseband_of(samples_of({59e3 + 0.2 * new_rate(rate)}, rate), Hertz(rate), Hertz(59e3));
    EXPECT_EQ(baseband.sample_rate, Hertz(new_rate(rate)));
    for (std::size_t i = 10; i + 10 < baseband.samples.size(); ++i) {
      const double turns = 0.2 * static_cast<double>(i);
      const auto wanted = std::polar(1.0, 2 * std::numbers::pi * turns);
      EXPECT_NEAR(std::abs(std::complex<double>(baseband.samples[i]) - wanted), 0, 0.004);
    }
  }
}

// The header's 74 dB; of a constant, as ambient light is, and of what decimation folds.
TEST(Baseband, HasNothingOfWhatIsFarFromTheCarrier) {
  for (const double rate : rates)
    for (const double away : {-59e3, -58.9e3, -0.5 * new_rate(rate), 0.5 * new_rate(rate), 49e3}) {
      const double hertz = 59e3 + away;
      const Baseband baseband = baseband_of(samples_of({hertz}, rate), Hertz(rate), Hertz(59e3));
      for (const auto& sample : inside(baseband))
        ASSERT_LT(std::abs(sample), 2 * std::pow(10, -74.0 / 20)) << rate << ' ' << hertz;
    }
}

}  // namespace
}  // namespace sim
