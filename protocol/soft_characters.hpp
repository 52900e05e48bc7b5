#pragma once
// Characters of a wire with how sure each bit is. Of all ways to lay 8N1 characters of 7-bit text
// over a stretch of light, with any pause between them, the one is taken whose own light differs
// from it for the least time (Viterbi's algorithm over possible starts): a start bit that noise has
// split, or swallowed, is then one bit of many.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "protocol/light_pulses.hpp"
#include "protocol/uart.hpp"

namespace protocol {

inline constexpr int text_bits = 7;

/// What time at the wrong level counts, in bits a bit. Light of weak signals has holes, and noise
/// flashes in the dark: the rarer of them says more. They sum to 2.
struct MismatchWeights {
  double hole = 1, flash = 1;

  /// Nothing would come out otherwise.
  bool are_even() const { return hole > 0.9 && hole < 1.1; }
};

struct SoftCharacter {
  dsp::Seconds start;
  std::array<double, bits_per_byte> light{};  // share of each slot
  /// Of data bits 0..6: how much less the mismatch is if it is dark; -1..1 if all weights are 1.
  std::array<double, text_bits> darkness{};
  /// In all ten slots if the character is value().
  double mismatch = 0;

  std::uint8_t value() const;
  /// How much more mismatch it would be if the character were `value`.
  double cost_of(std::uint8_t value) const;
};

/// Of a stretch of light before and behind which it is dark.
std::vector<SoftCharacter> parse_characters(std::span<const LightPulse> light, dsp::Seconds period,
                                            const MismatchWeights& weights = {});

/// By how much light is missing in the characters' slots that are known to be light, and how much
/// there is in those known to be dark: log-likelihoods of a binary asymmetric channel.
MismatchWeights estimate_weights(std::span<const SoftCharacter> characters);

}  // namespace protocol
