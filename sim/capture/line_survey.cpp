#include "sim/capture/line_survey.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "protocol/uart.hpp"
#include "sim/capture/line_statistics.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::LogicTrace;
using dsp::Seconds;

constexpr std::size_t most_pulses = 2000, fewest_pulses = 4;
constexpr double largest_excess = 0.35;  // of a pulse, in bits
constexpr double longest_light = 9.4;    // bits: a start bit and eight zeros, distorted
constexpr double longest_fall_to_fall = 10.4;
constexpr Hertz fastest{1e6};        // as --baud has it
constexpr double grid_step = 1.003;  // ten bits are then known to 1/30 of one

LogicTrace trace_of(const LineStretch& line, bool inverted) {
  LogicTrace trace(line.initial != inverted);
  for (const Seconds flip : line.flips) trace.flip_at(flip);
  trace.observe_until(line.end);
  return trace;
}

/// The longest stretch at a level.
double longest_at(const LineStretch& line, bool level) {
  double longest = 0;
  Seconds since;
  bool now = line.initial;
  for (const Seconds flip : line.flips) {
    if (now == level) longest = std::max(longest, (flip - since).value);
    since = flip;
    now = !now;
  }
  return now == level ? std::max(longest, (line.end - since).value) : longest;
}

struct Pulses {
  std::vector<double> light, fall_to_fall;  // s
};

Pulses pulses_of(const LineStretch& line, bool inverted) {
  Pulses pulses;
  const bool idle = line.initial != inverted;
  for (std::size_t fall = idle ? 0 : 1;
       fall + 2 < line.flips.size() && pulses.light.size() < most_pulses; fall += 2) {
    pulses.light.push_back((line.flips[fall + 1] - line.flips[fall]).value);
    pulses.fall_to_fall.push_back((line.flips[fall + 2] - line.flips[fall]).value);
  }
  if (pulses.light.empty() && line.flips.size() >= 2 && idle)
    pulses.light.push_back((line.flips[1] - line.flips[0]).value);
  return pulses;
}

/// Mean of exp(2 pi i time / bit) over times of up to `longest` bits: 1 where all are multiples.
/// The longer ones count as 0 if they may not be, and not at all otherwise.
std::complex<double> mean_phasor(const std::vector<double>& times, double bit, double longest,
                                 bool may_be_longer) {
  std::complex<double> sum;
  double count = 0;
  for (const double time : times) {
    const bool fits = time <= longest * bit;
    if (fits) sum += std::polar(1.0, 2 * std::numbers::pi * time / bit);
    count += fits || !may_be_longer;
  }
  return count == 0 ? 0 : sum / count;
}

/// 1 for a bit that explains every distance, about 0 for one that explains none.
double score(const Pulses& pulses, double bit) {
  const auto light = mean_phasor(pulses.light, bit, longest_light, false);
  if (std::abs(std::arg(light)) > 2 * std::numbers::pi * largest_excess) return 0;
  const auto falls = mean_phasor(pulses.fall_to_fall, bit, longest_fall_to_fall, true);
  return (std::abs(light) + falls.real()) / 2;
}

std::optional<Hertz> rate_of(const Pulses& pulses) {
  if (pulses.light.size() < fewest_pulses) return std::nullopt;
  std::vector<double> sorted = pulses.light;
  std::ranges::sort(sorted);
  const double shortest = sorted[sorted.size() / 10];
  std::vector<std::pair<double, double>> scores;  // bit, score; the longest bit first
  const double shortest_bit = std::max(shortest / 10, 1 / fastest.value);
  for (double bit = shortest / (1 - largest_excess); bit > shortest_bit; bit /= grid_step)
    scores.emplace_back(bit, score(pulses, bit));
  if (scores.empty()) return std::nullopt;
  const double best =
      std::ranges::max_element(scores, {}, [](const auto& s) { return s.second; })->second;
  if (best <= 0) return std::nullopt;
  const auto good = [&](const auto& s) { return s.second >= 0.9 * best; };
  auto peak = std::ranges::find_if(scores, good);
  while (std::next(peak) != scores.end() && std::next(peak)->second > peak->second) ++peak;
  return Hertz(1 / peak->first);
}

/// A standard rate that is near, else the rate that the characters themselves tell.
Hertz settled_rate(const LineStretch& line, bool inverted, Hertz found) {
  constexpr std::array standard = {300.0,  600.0,   1200.0,  2400.0,  4800.0,
                                   9600.0, 19200.0, 38400.0, 57600.0, 115200.0};
  for (const double rate : standard)
    if (std::abs(found.value / rate - 1) < 0.025) return Hertz(rate);
  LineStatistics statistics(found, line.initial != inverted);
  const auto bytes = protocol::receive_mid_bit(trace_of(line, inverted), found);
  statistics.add(line.flips, bytes);
  const auto fit = statistics.fit();
  return fit ? fit->baud : found;
}

Hertz found_rate(const LineStretch& line, bool inverted) {
  const auto rate = rate_of(pulses_of(line, inverted));
  return rate ? settled_rate(line, inverted, *rate) : LineFacts().baud;
}

/// Characters without a framing error, less those with one.
double worth(const LineStretch& line, bool inverted, std::optional<Hertz> baud) {
  double good = 0;
  const Hertz rate = baud ? *baud : found_rate(line, inverted);
  for (const auto& byte : protocol::receive_mid_bit(trace_of(line, inverted), rate))
    good += byte.framing_error ? -1 : 1;
  return good;
}

bool found_inverted(const LineStretch& line, std::optional<Hertz> baud) {
  const double high = longest_at(line, true), low = longest_at(line, false);
  if (line.flips.empty() || high >= 2 * low) return false;
  if (low >= 2 * high) return true;
  return worth(line, true, baud) > worth(line, false, baud);
}

}  // namespace

LineFacts survey_line(const LineStretch& line, std::optional<bool> inverted,
                      std::optional<Hertz> baud) {
  LineFacts facts;
  facts.inverted = inverted ? *inverted : found_inverted(line, baud);
  facts.baud = baud ? *baud : found_rate(line, facts.inverted);
  return facts;
}

}  // namespace sim
