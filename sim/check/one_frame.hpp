#pragma once
// One frame on the line that decoders are judged by, so that they meet it as they do there, and its
// bits: as they were sent, and as the receiver's pin has them.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/decoder.hpp"
#include "sim/check/judged_point.hpp"

namespace sim {

struct OneFrame {
  JudgedLink judged;
  DelimitedStream line;
  std::size_t index = 0;  // of line.frames

  const FrameOnLine& frame() const { return line.frames[index]; }
  std::uint32_t trial() const { return line.first + static_cast<std::uint32_t>(index); }
};
OneFrame hear_frame(const JudgedPoint& point, std::uint32_t trial);

FrameOutcome outcome_of(const Decoder& decoder, const OneFrame& frame);
/// Of what the decoder made of the whole line.
FrameOutcome outcome_of(const Decoded& decoded, const OneFrame& frame);

/// A bit of a frame: slot 0 is the start bit, 9 the stop bit.
struct BitPlace {
  std::size_t character = 0;
  int slot = 0;
};

/// Ten bits, as a UART sends them: 0 is light.
std::vector<bool> sent_bits(const OneFrame& frame, std::size_t character);
/// The pin in the middle of each, by a receiver that knows the sender's clock.
std::vector<bool> pin_bits(const OneFrame& frame, std::size_t character);
/// The first that the pin has otherwise; nothing where it has none.
std::optional<BitPlace> first_difference(const OneFrame& frame);

/// "'6'"
std::string quoted(std::uint8_t byte);
/// "character 16 '6', data bit 3"
std::string place_text(const OneFrame& frame, const BitPlace& place);

}  // namespace sim
