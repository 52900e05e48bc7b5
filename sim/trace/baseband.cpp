#include "sim/trace/baseband.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sim {
namespace {

constexpr dsp::Hertz wanted_rate{50e3};
constexpr double cutoff = 0.35;          // of the new rate: midway from 0.2 to 0.5
constexpr int half_length_a_sample = 9;  // of the filter: a transition of 5.5 / (2 * 9) = 0.3
constexpr double pi = std::numbers::pi;

/// Symmetric, of sum 1: coefficients from the middle one on.
std::vector<double> low_pass(int decimation) {
  const int half = half_length_a_sample * decimation;
  std::vector<double> taps;
  double sum = 0;
  for (int i = 0; i <= half; ++i) {
    const double x = 2 * cutoff * i / decimation, angle = pi * i / (half + 1);
    const double sinc = i == 0 ? 1 : std::sin(pi * x) / (pi * x);
    taps.push_back(sinc * (0.42 + 0.5 * std::cos(angle) + 0.08 * std::cos(2 * angle)));
    sum += (i == 0 ? 1 : 2) * taps.back();
  }
  for (double& tap : taps) tap /= sum;
  return taps;
}

std::vector<std::complex<double>> mixed_down(std::span<const float> signal, double cycles) {
  std::vector<std::complex<double>> down;
  down.reserve(signal.size());
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const double turns = static_cast<double>(i) * cycles;
    down.push_back(
        std::polar(2.0 * static_cast<double>(signal[i]), -2 * pi * (turns - std::floor(turns))));
  }
  return down;
}

std::complex<double> filtered(const std::vector<std::complex<double>>& signal, std::size_t at,
                              const std::vector<double>& taps) {
  std::complex<double> sum = taps[0] * signal[at];
  for (std::size_t i = 1; i < taps.size(); ++i) {
    if (i <= at) sum += taps[i] * signal[at - i];
    if (at + i < signal.size()) sum += taps[i] * signal[at + i];
  }
  return sum;
}

}  // namespace

Baseband baseband_of(std::span<const float> signal, dsp::Hertz sample_rate, dsp::Hertz carrier) {
  const int decimation = std::max(1, static_cast<int>(sample_rate / wanted_rate));
  const std::vector<double> taps = low_pass(decimation);
  const auto down = mixed_down(signal, carrier / sample_rate);
  Baseband baseband{{}, sample_rate / decimation};
  for (std::size_t at = 0; at < down.size(); at += static_cast<std::size_t>(decimation))
    baseband.samples.emplace_back(filtered(down, at, taps));
  return baseband;
}

}  // namespace sim
