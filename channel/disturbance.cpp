#include "channel/disturbance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace channel {
namespace {

using std::numbers::pi;

// ---- tables of periodic light ----

/// As many whole periods as make a table of about this length: its frequency is then right within
/// 1 in 20000, whatever the sample rate.
constexpr double enough_samples = 16384;

struct TableLength {
  double periods;
  std::uint32_t samples;
};

TableLength table_length(dsp::Hertz frequency, dsp::Hertz sample_rate) {
  const double period = sample_rate / frequency;
  const double periods = std::max(1.0, std::floor(enough_samples / period));
  return {periods, static_cast<std::uint32_t>(std::llround(periods * period))};
}

/// `integral` is that of the wave, mW/m2 times cycles: a sample is its mean.
template <class Integral>
std::vector<float> table_of(dsp::Hertz frequency, dsp::Hertz sample_rate, Integral integral) {
  const auto [periods, samples] = table_length(frequency, sample_rate);
  const double step = periods / samples;
  std::vector<float> table;
  table.reserve(samples + longest_interference_block);
  double before = integral(0.0);
  for (std::uint32_t i = 1; i <= samples; ++i) {
    const double now = integral(i * step);
    table.push_back(static_cast<float>((now - before) / step));
    before = now;
  }
  for (std::size_t i = 0; i < longest_interference_block; ++i) table.push_back(table[i]);
  return table;
}

// ---- Moreira's fluorescent lamp ----

constexpr double low_scale = 5.9;   // A3
constexpr double high_scale = 2.1;  // A4

constexpr double odd_phase[] = {4.65, 2.86, 5.43, 3.90, 2.00, 5.98, 2.38, 4.35, 5.87, 0.70,
                                1.26, 1.29, 1.28, 0.63, 6.06, 5.49, 4.45, 3.24, 2.07, 0.87};
constexpr double even_phase[] = {0.00, 0.08, 6.00, 5.31, 2.27, 5.70, 2.07, 3.44, 5.01, 6.00,
                                 6.00, 6.17, 5.69, 5.37, 4.00, 3.69, 1.86, 1.38, 5.91, 4.88};

double amplitude_of(double decibels) { return std::pow(10, decibels / 20); }

/// Line `harmonic` of 50 Hz mains, 1 ... 40, relative to the mean light.
double low_line(int harmonic) {
  const double hertz = 50.0 * harmonic;
  const double decibels =
      harmonic % 2 == 1 ? -13.1 * std::log(hertz) + 27.1 : -20.8 * std::log(hertz) + 92.4;
  return amplitude_of(decibels) / low_scale;
}

double low_phase(int harmonic) {
  const int i = (harmonic - 1) / 2;
  return harmonic % 2 == 1 ? odd_phase[i] : even_phase[i];
}

constexpr int low_lines = 40;

struct BallastLine {
  int harmonic;
  double decibels, phase;
};
constexpr BallastLine ballast_lines[] = {{1, -22.2, 5.09},  {2, 0.0, 0.00},    {4, -11.5, 2.37},
                                         {6, -30.0, 5.86},  {8, -33.9, 2.04},  {10, -35.3, 2.75},
                                         {12, -39.3, 3.55}, {14, -42.7, 4.15}, {16, -46.4, 1.64},
                                         {18, -48.1, 4.51}, {20, -53.1, 3.55}, {22, -54.9, 1.78}};

double line_amplitude(const BallastLine& line, double decibels_per_decade) {
  return std::pow(10, line.decibels / decibels_per_decade) / high_scale;
}

std::uint32_t phase_word(double cycles) {
  return static_cast<std::uint32_t>(std::llround((cycles - std::floor(cycles)) * 0x1p32));
}

ToneDesign design_tone(const BallastLine& line, const FluorescentLight& lamp,
                       dsp::Hertz sample_rate) {
  const auto harmonic = static_cast<std::uint32_t>(line.harmonic);
  const std::uint32_t step = phase_word(lamp.ballast / sample_rate) * harmonic;
  const double turn = 2 * pi * step * 0x1p-32;
  const double amplitude =
      lamp.ballast_share * line_amplitude(line, lamp.decibels_per_decade) * lamp.mean.value * 1e3;
  return {.step = step,
          .phase = phase_word(line.phase / (2 * pi)),
          .harmonic = harmonic,
          .turn_cosine = static_cast<float>(std::cos(turn)),
          .turn_sine = static_cast<float>(std::sin(turn)),
          .amplitude = static_cast<float>(amplitude)};
}

std::vector<ToneDesign> ballast_tones(const FluorescentLight& lamp, dsp::Hertz sample_rate) {
  std::vector<ToneDesign> tones;
  for (const BallastLine& line : ballast_lines)
    if (2 * line.harmonic * lamp.ballast < sample_rate)
      tones.push_back(design_tone(line, lamp, sample_rate));
  return tones;
}

/// Integral of the low part over cycles of the mains.
double low_integral(double mains_cycles) {
  double sum = 0;
  for (int k = 1; k <= low_lines; ++k)
    sum += low_line(k) * std::sin(2 * pi * k * mains_cycles + low_phase(k)) / (2 * pi * k);
  return sum;
}

}  // namespace

double fluorescent_low_part(double mains_cycles) {
  double sum = 0;
  for (int k = 1; k <= low_lines; ++k)
    sum += low_line(k) * std::cos(2 * pi * k * mains_cycles + low_phase(k));
  return sum;
}

double fluorescent_line(int harmonic, double decibels_per_decade) {
  const auto* line = std::ranges::find(ballast_lines, harmonic, &BallastLine::harmonic);
  return line == std::end(ballast_lines) ? 0 : line_amplitude(*line, decibels_per_decade);
}

Disturbance design_fluorescent(const FluorescentLight& lamp, dsp::Hertz sample_rate) {
  const double mean = lamp.mean.value * 1e3;
  return {.tones = ballast_tones(lamp, sample_rate),
          .table = table_of(lamp.mains, sample_rate,
                            [&](double cycles) { return mean * low_integral(cycles); })};
}

Disturbance design_ripple(dsp::WattsPerSquareMetre mean, dsp::Hertz mains, double depth,
                          dsp::Hertz sample_rate) {
  const double amplitude = mean.value * 1e3 * depth;
  const auto integral = [&](double cycles) {
    return amplitude * std::sin(2 * pi * cycles) / (2 * pi);
  };
  return {.table = table_of(2 * mains, sample_rate, integral)};
}

Disturbance design_pwm(dsp::WattsPerSquareMetre mean, dsp::Hertz frequency, double duty,
                       dsp::Hertz sample_rate) {
  const double level = mean.value * 1e3;
  const auto integral = [&](double cycles) {
    const double lit = std::floor(cycles) + std::min((cycles - std::floor(cycles)) / duty, 1.0);
    return level * (lit - cycles);
  };
  return {.table = table_of(frequency, sample_rate, integral)};
}

Disturbance design_keyed_light(dsp::WattsPerSquareMetre peak, dsp::Hertz carrier, double duty,
                               dsp::Hertz sample_rate) {
  return {.carrier = design_carrier(peak, carrier, duty, sample_rate)};
}

CarrierDesign design_carrier(dsp::WattsPerSquareMetre peak, dsp::Hertz carrier, double duty,
                             dsp::Hertz sample_rate) {
  const double cycles = carrier / sample_rate;
  const double half = pi * cycles;
  const double droop = std::sin(half) / half;  // of the mean over a sample, at the carrier
  return {.step = static_cast<std::uint32_t>(std::llround(cycles * 0x1p32)),
          .cycles = static_cast<float>(cycles),
          .duty = static_cast<float>(duty),
          .amplitude = static_cast<float>(peak.value * 1e3 / droop / cycles)};
}

}  // namespace channel
