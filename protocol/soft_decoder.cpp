#include "protocol/soft_decoder.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "protocol/bit_timing.hpp"
#include "protocol/cosys.hpp"
#include "protocol/soft_characters.hpp"

namespace protocol {
namespace {

using dsp::Seconds;

/// Two and a half characters: whatever comes then may be another sender's, of another clock.
constexpr double pause_bits = 25;
/// Devices pause for 100 ms at least (COSYS protocol), 60 bits; less a clock that is off.
constexpr double long_pause_bits = 55;
/// The longest line has five pulses a character. The rest is for noise.
constexpr std::size_t most_pulses = 4 * 5 * default_max_line;

std::vector<SoftCharacter> characters_of(std::span<const LightPulse> burst, Seconds bit) {
  const BitTiming timing = estimate_bit_timing(burst, bit);
  const auto light = without_lengthening(burst, timing.lengthening);
  const auto plain = parse_characters(light, timing.period);
  const MismatchWeights weights = estimate_weights(plain);
  return weights.are_even() ? plain : parse_characters(light, timing.period, weights);
}

}  // namespace

SoftDecoder::SoftDecoder(dsp::Hertz baud, SoftMemory memory, bool initial)
    : bit_(dsp::period(baud)),
      level_(initial),
      last_rise_(-std::numeric_limits<double>::infinity()),
      finder_(memory) {}

std::vector<SoftMessage> SoftDecoder::take(std::span<const Seconds> edges, Seconds known_until) {
  for (const Seconds edge : edges) {
    level_ = !level_;
    if (!level_) {
      fall(edge);
    } else if (!burst_.empty()) {
      burst_.back().rise = last_rise_ = edge;
    }
  }
  if (level_ && is_paused(known_until, pause_bits)) end_burst();
  return std::exchange(accepted_, {});
}

std::vector<SoftMessage> SoftDecoder::finish() {
  end_burst();
  return std::exchange(accepted_, {});
}

bool SoftDecoder::is_paused(Seconds until, double bits) const {
  return until - last_rise_ > bits * bit_;
}

void SoftDecoder::fall(Seconds t) {
  if (is_paused(t, pause_bits)) end_burst();
  if (burst_.size() == most_pulses) give_up_pause();
  if (burst_.empty()) after_long_pause_ = is_paused(t, long_pause_bits);
  burst_.push_back({t, t});
}

void SoftDecoder::end_burst() {
  if (!burst_.empty()) take_characters(characters_of(burst_, bit_));
  burst_.clear();
}

/// Without a pause the last character may be half there, and the one before misled by it: they come
/// again with the rest.
void SoftDecoder::give_up_pause() {
  auto characters = characters_of(burst_, bit_);
  if (characters.size() <= 2) return end_burst();
  const Seconds rest = characters[characters.size() - 2].start - 0.5 * bit_;
  characters.resize(characters.size() - 2);
  take_characters(characters);
  std::erase_if(burst_, [=](const LightPulse& pulse) { return pulse.fall < rest; });
}

void SoftDecoder::take_characters(const std::vector<SoftCharacter>& characters) {
  auto accepted = finder_.take(characters, after_long_pause_);
  std::ranges::move(accepted, std::back_inserter(accepted_));
  after_long_pause_ = false;
}

std::vector<SoftMessage> decode_soft(const dsp::LogicTrace& line, dsp::Hertz baud,
                                     SoftMemory memory) {
  SoftDecoder decoder(baud, memory, line.initial());
  auto messages = decoder.take(line.edges(), line.end());
  std::ranges::move(decoder.finish(), std::back_inserter(messages));
  return messages;
}

}  // namespace protocol
