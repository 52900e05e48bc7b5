#include "sim/capture/autobaud.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "protocol/cosys.hpp"
#include "protocol/shared_link.hpp"
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
constexpr std::size_t most_rates = 8;
constexpr double least_peak = 0.5;  // of the best; a slow sampler rounds times by a third of a bit
constexpr double nearly = 0.9;      // of the worth of the best reading: about as good
constexpr std::uint64_t fewest_to_doubt = 4;  // characters
constexpr double edges_a_character = 10;      // at most
constexpr double against_pauses = 0.7;        // of the worth
constexpr double least_worth = 0.5;           // of what is a line
constexpr std::array standard_rates = {300.0,    600.0,    1200.0,   2400.0,  4800.0,
                                       9600.0,   19200.0,  31250.0,  38400.0, 57600.0,
                                       115200.0, 230400.0, 460800.0, 921600.0};

LogicTrace trace_of(const LineStretch& line, bool inverted) {
  LogicTrace trace(line.initial != inverted);
  for (const Seconds edge : line.edges) trace.add_edge(edge);
  trace.observe_until(line.end);
  return trace;
}

/// The longest stretch at each level.
struct Longest {
  double high = 0, low = 0;

  bool tell() const { return high >= 2 * low || low >= 2 * high; }
  bool tell_low() const { return low > high; }
};

Longest longest_of(const LineStretch& line, bool with_ends) {
  Longest longest;
  Seconds since;
  bool level = line.initial, is_first = true;
  const auto count = [&](Seconds until) {
    double& at_level = level ? longest.high : longest.low;
    at_level = std::max(at_level, (until - since).value);
  };
  for (const Seconds edge : line.edges) {
    if (with_ends || !is_first) count(edge);
    is_first = false;
    since = edge;
    level = !level;
  }
  if (with_ends) count(line.end);
  return longest;
}

struct Pulses {
  std::vector<double> light, fall_to_fall;  // s
};

Pulses pulses_of(const LineStretch& line, bool inverted) {
  Pulses pulses;
  const bool idle = line.initial != inverted;
  for (std::size_t fall = idle ? 0 : 1;
       fall + 2 < line.edges.size() && pulses.light.size() < most_pulses; fall += 2) {
    pulses.light.push_back((line.edges[fall + 1] - line.edges[fall]).value);
    pulses.fall_to_fall.push_back((line.edges[fall + 2] - line.edges[fall]).value);
  }
  if (pulses.light.empty() && line.edges.size() >= 2 && idle)
    pulses.light.push_back((line.edges[1] - line.edges[0]).value);
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

using Score = std::pair<double, double>;  // a bit, and what score() says of it

Seconds shortest_bit_of(const LineStretch& line) {
  return std::max(dsp::period(fastest), 2 * line.resolution);
}

/// The longest bit first.
std::vector<Score> scores_of(const Pulses& pulses, Seconds shortest_possible) {
  if (pulses.light.size() < fewest_pulses) return {};
  std::vector<double> sorted = pulses.light;
  std::ranges::sort(sorted);
  const double shortest = sorted[sorted.size() / 10];
  std::vector<Score> scores;
  const double shortest_bit = std::max(shortest / 10, shortest_possible.value);
  for (double bit = shortest / (1 - largest_excess); bit > shortest_bit; bit /= grid_step)
    scores.emplace_back(bit, score(pulses, bit));
  return scores;
}

/// Peaks of the score, the longest bit first; a slow sampler's own period may be the best of them.
std::vector<Hertz> rates_of(const LineStretch& line, bool inverted) {
  const std::vector<Score> scores = scores_of(pulses_of(line, inverted), shortest_bit_of(line));
  double best = 0;
  for (const Score& s : scores) best = std::max(best, s.second);
  std::vector<Hertz> rates;
  for (std::size_t i = 0; i < scores.size() && best > 0 && rates.size() < most_rates; ++i) {
    const double before = i == 0 ? 0 : scores[i - 1].second,
                 after = i + 1 == scores.size() ? 0 : scores[i + 1].second;
    if (scores[i].second >= least_peak * best && scores[i].second >= before &&
        scores[i].second > after)
      rates.emplace_back(1 / scores[i].first);
  }
  return rates;
}

bool is_near(Hertz found, double rate) { return std::abs(found.value / rate - 1) < 0.025; }

/// A standard rate that is near, else the rate that the characters themselves tell.
Hertz settled_rate(const LineStretch& line, bool inverted, Hertz found) {
  for (const double rate : standard_rates)
    if (is_near(found, rate)) return Hertz(rate);
  LineStatistics statistics(found, line.initial != inverted);
  const auto bytes = protocol::receive_mid_bit(trace_of(line, inverted), found);
  statistics.add(line.edges, bytes);
  const auto fit = statistics.fit();
  return fit ? fit->baud : found;
}

std::vector<Hertz> found_rates(const LineStretch& line, bool inverted) {
  std::vector<Hertz> rates;
  for (const Hertz rate : rates_of(line, inverted))
    rates.push_back(settled_rate(line, inverted, rate));
  if (rates.empty()) rates.push_back(LineFacts().baud);
  return rates;
}

std::vector<Hertz> standard_rates_for(const LineStretch& line) {
  std::vector<Hertz> rates;
  for (const double rate : standard_rates)
    if (dsp::period(Hertz(rate)) >= shortest_bit_of(line)) rates.emplace_back(rate);
  return rates;
}

bool is_of_text(std::uint8_t byte) {
  return (byte >= 0x20 && byte < 0x7f) || byte == '\r' || byte == '\n' || byte == '\t';
}

LineReading read_as(LineStretch line, bool inverted, Hertz baud) {
  if (!line.edges.empty()) line.end = end_of_line(line.edges.back(), line.end, baud);
  LineReading reading{inverted, baud};
  reading.edges = line.edges.size();
  protocol::CosysDecoder cosys;
  protocol::SharedLinkDecoder shared_link;
  std::array<std::uint64_t, 256> of_value{};
  for (const auto& byte : protocol::receive_mid_bit(trace_of(line, inverted), baud)) {
    ++reading.characters;
    reading.most_alike = std::max(reading.most_alike, ++of_value[byte.value]);
    if (byte.framing_error) {
      ++reading.framing_errors;
    } else if (is_of_text(byte.value)) {
      ++reading.of_text;
    }
    const auto frame = cosys.push(byte);
    if (frame && frame->outcome == protocol::CosysOutcome::ok) ++reading.messages;
    const auto message = shared_link.push(byte);
    if (message && message->outcome == protocol::SharedLinkOutcome::ok) ++reading.messages;
  }
  return reading;
}

/// Why a reading is none of a line.
std::optional<std::string> why_none(const LineReading& reading) {
  constexpr double most_errors = 0.25, many_errors = 0.1, most_alike = 0.9;  // of all characters
  if (reading.messages > 0) return std::nullopt;
  if (reading.characters == 0)
    return fmt::format("its {} edges make no character at any rate that was tried", reading.edges);
  const auto characters = static_cast<double>(reading.characters);
  if (static_cast<double>(reading.edges) > 2 * edges_a_character * characters)
    return fmt::format("of {} edges most are in none of {} characters", reading.edges,
                       reading.characters);
  if (reading.characters < fewest_to_doubt)
    return fmt::format("{} characters tell no rate", reading.characters);
  if (static_cast<double>(reading.most_alike) > most_alike * characters)
    return fmt::format("{} of {} characters are the same, as those of a clock", reading.most_alike,
                       reading.characters);
  const double errors = static_cast<double>(reading.framing_errors) / characters;
  if (errors > most_errors || (errors > many_errors && reading.worth() < least_worth))
    return fmt::format(
        "{} of {} characters have a framing error at {:.6g} Bd, as noise or a code other than 8N1 "
        "has",
        reading.framing_errors, reading.characters, reading.baud.value);
  return std::nullopt;
}

/// Of a line, of both idle levels or of the one that was told; `rates` of an idle level.
template <class Rates>
std::vector<LineReading> readings_at(const LineStretch& line, std::optional<bool> inverted,
                                     const Rates& rates) {
  constexpr double longest_pulse = 12;  // bits
  const Longest longest = longest_of(line, false);
  std::vector<LineReading> readings;
  for (const bool idle_low : {false, true}) {
    if (inverted.value_or(idle_low) != idle_low) continue;
    const double at_start = idle_low ? longest.high : longest.low,  // the start bit's level
        at_idle = idle_low ? longest.low : longest.high;
    for (const Hertz rate : rates(idle_low)) {
      readings.push_back(read_as(line, idle_low, rate));
      readings.back().is_against_pauses =
          at_start >= 2 * at_idle && at_start * rate.value > longest_pulse;
    }
  }
  return readings;
}

std::vector<LineReading> readings_of(const LineStretch& line, std::optional<bool> inverted,
                                     std::optional<Hertz> baud) {
  auto readings = readings_at(line, inverted, [&](bool idle_low) {
    return baud ? std::vector<Hertz>{*baud} : found_rates(line, idle_low);
  });
  const auto has_messages = [](const LineReading& reading) { return reading.messages > 0; };
  if (baud || line.edges.empty() || std::ranges::any_of(readings, has_messages)) return readings;
  const bool any_makes_sense = std::ranges::any_of(readings, makes_sense);
  for (const LineReading& reading :
       readings_at(line, inverted, [&](bool) { return standard_rates_for(line); }))
    if (has_messages(reading) || !any_makes_sense) readings.push_back(reading);
  return readings;
}

/// The idle level that the longest stretch tells: between two edges, else before and behind them.
std::optional<bool> inverted_by_pauses(const LineStretch& line) {
  for (const bool with_ends : {false, true}) {
    const Longest longest = longest_of(line, with_ends);
    const bool are_two = with_ends || (longest.high > 0 && longest.low > 0);
    if (!line.edges.empty() && are_two && longest.tell()) return longest.tell_low();
  }
  return std::nullopt;
}

bool is_about_as_good(const LineReading& reading, const LineReading& best) {
  return reading.worth() >= nearly * best.worth();
}

/// Of several about as good: by the pauses, then the first, which of those found has the longest
/// bit.
const LineReading& best_of(const std::vector<LineReading>& readings,
                           std::optional<bool> by_pauses) {
  const LineReading& best = *std::ranges::max_element(readings, {}, &LineReading::worth);
  const LineReading* taken = nullptr;
  for (const LineReading& reading : readings) {
    if (!is_about_as_good(reading, best)) continue;
    if (taken == nullptr ||
        (by_pauses && taken->inverted != *by_pauses && reading.inverted == *by_pauses))
      taken = &reading;
  }
  return *taken;
}

/// Another reading as good, which nothing sets apart from the one taken.
std::optional<LineReading> rival_of(const std::vector<LineReading>& readings,
                                    const LineReading& taken, std::optional<bool> by_pauses) {
  for (const LineReading& reading : readings) {
    const bool is_same =
        reading.inverted == taken.inverted && std::abs(reading.baud / taken.baud - 1) < 0.1;
    const bool pauses_tell = by_pauses && reading.inverted != taken.inverted;
    if (is_same || pauses_tell || taken.characters < fewest_to_doubt ||
        reading.characters < fewest_to_doubt)
      continue;
    if (reading.inverted == taken.inverted && reading.baud > taken.baud) continue;  // by rule
    if (is_about_as_good(reading, taken)) return reading;
  }
  return std::nullopt;
}

bool any_differs(const std::vector<LineReading>& readings, const LineReading& taken) {
  return std::ranges::any_of(readings, [&](const LineReading& reading) {
    return reading.inverted != taken.inverted && !is_about_as_good(reading, taken);
  });
}

LineFacts::Basis basis_of_polarity(const std::vector<LineReading>& readings,
                                   const LineReading& taken, std::optional<bool> by_pauses) {
  if (taken.characters > 0 && any_differs(readings, taken)) return LineFacts::Basis::characters;
  return by_pauses == taken.inverted ? LineFacts::Basis::pauses : LineFacts::Basis::assumed;
}

}  // namespace

double LineReading::worth() const {
  if (characters == 0) return 0;
  const double most_explained = edges_a_character * static_cast<double>(characters),
               explained = std::min(1.0, most_explained / static_cast<double>(edges));
  const auto all = static_cast<double>(characters + 1);  // one alone proves little
  const double good = static_cast<double>(characters - framing_errors) / all,
               text = static_cast<double>(of_text) / all;
  const double sense = (good + text) / 2 * explained * (is_against_pauses ? against_pauses : 1);
  return sense + (messages > 0 ? 1 : 0);
}

std::optional<std::string> why_no_line(const LineFacts& facts) {
  if (facts.baud_by == LineFacts::Basis::told || facts.reading.edges == 0) return std::nullopt;
  return why_none(facts.reading);
}

bool makes_sense(const LineReading& reading) { return reading.edges > 0 && !why_none(reading); }

LineFacts survey_line(const LineStretch& line, std::optional<bool> inverted,
                      std::optional<Hertz> baud) {
  const std::vector<LineReading> readings = readings_of(line, inverted, baud);
  const std::optional<bool> by_pauses = inverted_by_pauses(line);
  const LineReading& taken = best_of(readings, by_pauses);
  LineFacts facts;
  facts.inverted = taken.inverted;
  facts.baud = taken.baud;
  facts.polarity_by =
      inverted ? LineFacts::Basis::told : basis_of_polarity(readings, taken, by_pauses);
  const bool tells = taken.characters > 0 && !rates_of(line, taken.inverted).empty();
  facts.baud_by = baud    ? LineFacts::Basis::told
                  : tells ? LineFacts::Basis::characters
                          : LineFacts::Basis::assumed;
  facts.reading = taken;
  facts.rival = rival_of(readings, taken, by_pauses);
  return facts;
}

bool is_standard_rate(Hertz rate) {
  return std::ranges::any_of(standard_rates,
                             [&](double standard) { return is_near(rate, standard); });
}

Seconds end_of_line(std::optional<Seconds> last_edge, Seconds end, Hertz baud) {
  if (!last_edge || end > *last_edge) return end;
  return *last_edge + protocol::bits_per_byte * dsp::period(baud);
}

std::string reading_text(const LineReading& reading) {
  return fmt::format("idle-{}, {:.6g} Bd", reading.inverted ? "low" : "high", reading.baud.value);
}

}  // namespace sim
