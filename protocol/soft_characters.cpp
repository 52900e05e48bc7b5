#include "protocol/soft_characters.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace protocol {
namespace {

using dsp::Seconds;

/// The edges of a slot are not looked at: pulses end early or late by some hundredths of a bit.
constexpr double slot_margin = 0.1;

/// The next character may begin so many bits behind a start: early by what edges and the bit period
/// are off.
constexpr double least_distance = bits_per_byte - 0.4;

/// Rates of holes and flashes. Fewer than one in a hundred are not to be told by the slots of one
/// message, seventy characters' worth; with more than two in five nothing is to be seen.
constexpr double least_rate = 0.01, most_rate = 0.4;

bool bit_of(std::uint8_t value, int i) {
  return ((unsigned{value} >> static_cast<unsigned>(i)) & 1U) != 0;
}

/// Share of slots 0..9 that is light.
std::array<double, bits_per_byte> light_shares(LightMeasure measure, Seconds start,
                                               Seconds period) {
  std::array<double, bits_per_byte> shares{};
  for (int slot = 0; slot < bits_per_byte; ++slot) {
    const double end = slot == stop_slot ? least_distance : slot + 1 - slot_margin;
    const Seconds from = measure.until(start + (slot + slot_margin) * period);
    const Seconds until = measure.until(start + end * period);
    shares[static_cast<std::size_t>(slot)] = (until - from) / ((end - slot - slot_margin) * period);
  }
  return shares;
}

SoftCharacter character_at(const LightMeasure& measure, Seconds start, Seconds period,
                           const MismatchWeights& weights) {
  SoftCharacter c{.start = start, .light = light_shares(measure, start, period)};
  c.mismatch = weights.hole * ((1 - c.light[0]) + (1 - c.light[data_bits])) +
               weights.flash * c.light[stop_slot];
  for (std::size_t i = 0; i < text_bits; ++i) {
    const double if_light = weights.hole * (1 - c.light[i + 1]);
    const double if_dark = weights.flash * c.light[i + 1];
    c.darkness[i] = if_light - if_dark;
    c.mismatch += std::min(if_light, if_dark);
  }
  return c;
}

/// Falls, and a character to each side of them: the start between may be missing.
struct PossibleStart {
  Seconds at;
  bool is_fall;
};

std::vector<PossibleStart> possible_starts(std::span<const LightPulse> light, Seconds period) {
  std::vector<PossibleStart> starts;
  for (const LightPulse& pulse : light)
    for (const int characters : {-1, 0, 1})
      starts.push_back({pulse.fall + characters * bits_per_byte * period, characters == 0});
  std::ranges::sort(starts, {}, &PossibleStart::at);
  return starts;
}

/// Bits. Of two starts that explain as much the one that was seen is right.
constexpr double mismatch_of_missing_fall = 0.05;

/// A way to lie over the light up to some time.
struct Path {
  std::ptrdiff_t last = -1;  // character; -1: none
  double mismatch = 0;       // bits
};

/// Viterbi's algorithm. A possible start's path is the best of those that end before it.
class Parser {
 public:
  Parser(std::span<const LightPulse> light, Seconds period, const MismatchWeights& weights)
      : light_(light), period_(period), weights_(weights), until_start_(light), until_end_(light) {}

  std::vector<SoftCharacter> parse() {
    for (const PossibleStart& start : possible_starts(light_, period_)) add(start);
    while (next_end_ < steps_.size()) end_next();
    return characters_of(best_ended_);
  }

 private:
  struct Step {
    SoftCharacter character;
    Path before;
  };

  Seconds end_of(const Step& step) const { return step.character.start + least_distance * period_; }

  void add(const PossibleStart& possible) {
    const Seconds start = possible.at;
    while (next_end_ < steps_.size() && end_of(steps_[next_end_]) <= start) end_next();
    while (next_pulse_ < light_.size() && light_[next_pulse_].rise <= start) ++next_pulse_;
    const double outside = weights_.flash * (until_start_.until(start) / period_);
    const double missing = possible.is_fall ? 0 : mismatch_of_missing_fall;
    steps_.push_back({character_at(LightMeasure(light_, next_pulse_), start, period_, weights_),
                      {best_ended_.last, best_ended_.mismatch + outside + missing}});
  }

  /// Mismatches of paths that have ended leave out the light of all time before: what of it lies
  /// behind their end is then a mismatch.
  void end_next() {
    const Step& step = steps_[next_end_];
    const double outside = weights_.flash * (until_end_.until(end_of(step)) / period_);
    const double mismatch = step.before.mismatch + step.character.mismatch - outside;
    if (mismatch < best_ended_.mismatch)
      best_ended_ = {static_cast<std::ptrdiff_t>(next_end_), mismatch};
    ++next_end_;
  }

  std::vector<SoftCharacter> characters_of(Path path) const {
    std::vector<SoftCharacter> characters;
    while (path.last >= 0) {
      const Step& step = steps_[static_cast<std::size_t>(path.last)];
      characters.push_back(step.character);
      path = step.before;
    }
    std::ranges::reverse(characters);
    return characters;
  }

  std::span<const LightPulse> light_;
  Seconds period_;
  MismatchWeights weights_;
  LightMeasure until_start_, until_end_;
  std::vector<Step> steps_;
  std::size_t next_end_ = 0, next_pulse_ = 0;
  Path best_ended_;
};

}  // namespace

std::uint8_t SoftCharacter::value() const {
  unsigned value = 0;
  for (std::size_t i = 0; i < text_bits; ++i) value |= unsigned{darkness[i] > 0} << i;
  return static_cast<std::uint8_t>(value);
}

double SoftCharacter::cost_of(std::uint8_t value) const {
  double sum = 0;
  for (int i = 0; i < text_bits; ++i) {
    const double d = darkness[static_cast<std::size_t>(i)];
    if (bit_of(value, i) != (d > 0)) sum += std::abs(d);
  }
  return sum;
}

std::vector<SoftCharacter> parse_characters(std::span<const LightPulse> light, Seconds period,
                                            const MismatchWeights& weights) {
  return Parser(light, period, weights).parse();
}

MismatchWeights estimate_weights(std::span<const SoftCharacter> characters) {
  double holes = 0, flashes = 0;
  for (const SoftCharacter& character : characters) {
    holes += 1 - (character.light[0] + character.light[data_bits]) / 2;
    flashes += character.light[stop_slot];
  }
  const double n = std::max(1.0, static_cast<double>(characters.size()));
  const double h = std::clamp(holes / n, least_rate, most_rate);
  const double f = std::clamp(flashes / n, least_rate, most_rate);
  const double hole = std::log((1 - f) / h), flash = std::log((1 - h) / f);
  return {.hole = 2 * hole / (hole + flash), .flash = 2 * flash / (hole + flash)};
}

}  // namespace protocol
