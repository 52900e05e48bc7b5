#pragma once
// Tally: what was sent against what was heard, in integers, so that the order of adding cannot
// change a result; but for the sums of weighted trials, which are added in their order. Names and
// meanings are those of the result file.
#include <cstdint>

#include "sim/counting/weighted.hpp"

namespace sim {

struct Tally {
  std::uint64_t n_bits = 0;               // line bits sent (10 a character)
  std::uint64_t n_bit_errors = 0;         // pin at the centre of the bit slot differs from the bit
  std::uint64_t n_bytes = 0;              // characters sent
  std::uint64_t n_byte_errors = 0;        // not received, or received as another
  std::uint64_t n_framing_errors = 0;     // of those heard within the message: stop bit read as 0
  std::uint64_t n_frames = 0;             // messages sent
  std::uint64_t n_frames_ok = 0;          // delivered intact
  std::uint64_t n_frames_lost = 0;        // not delivered intact
  std::uint64_t n_frames_undetected = 0;  // passed the checksum, but are not what was sent
  std::uint64_t n_frames_false = 0;       // accepted though none was sent
  // Lost frames of which the decoder rejected nothing.
  std::uint64_t n_frames_unheard = 0;  // not one character was received
  std::uint64_t n_frames_unended = 0;  // characters were, but no line ended
  // Rejected lines, by the decoder's reason.
  std::uint64_t n_rejected_unprintable = 0;
  std::uint64_t n_rejected_short = 0;
  std::uint64_t n_rejected_not_hex = 0;
  std::uint64_t n_rejected_checksum = 0;
  std::uint64_t n_rejected_overlong = 0;
  // What the interval of the BER needs of frames: bits fail together in a frame.
  std::uint64_t n_frames_bit_errors = 0;  // with a bit that is wrong
  std::uint64_t sum_bit_errors_squared = 0;
  std::uint64_t sum_bits_squared = 0;
  std::uint64_t sum_bit_errors_times_bits = 0;
  // Where trials have weights this, and not the counts, tells the ratios.
  Weighted weighted{};

  bool is_weighted() const { return weighted.n_groups > 0; }
  Tally& operator+=(const Tally& o);
  bool operator==(const Tally&) const = default;
};

}  // namespace sim
