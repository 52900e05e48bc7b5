#include "sim/check/one_frame.hpp"

#include <fmt/format.h>

#include <span>
#include <utility>

#include "protocol/uart.hpp"
#include "sim/check/decoded_frames.hpp"
#include "sim/text/escaped_text.hpp"

namespace sim {

using protocol::bits_per_byte;

OneFrame hear_frame(const JudgedPoint& point, std::uint32_t trial) {
  const std::uint32_t first = trial / frames_per_capture * frames_per_capture;
  JudgedLink judged = judged_link(point);
  DelimitedStream line = hear_delimited(judged, first, static_cast<int>(frames_per_capture));
  return {std::move(judged), std::move(line), trial - first};
}

FrameOutcome outcome_of(const Decoded& decoded, const OneFrame& frame) {
  if (decoded.fault) return {.unknown = true};
  return outcomes_between_markers(decoded.accepted, frame.judged.link.message, frame.line.first,
                                  frame.line.frames.size())[frame.index];
}

FrameOutcome outcome_of(const Decoder& decoder, const OneFrame& frame) {
  return outcome_of(decoder.decode(frame.line), frame);
}

std::vector<bool> sent_bits(const OneFrame& frame, std::size_t character) {
  return protocol::line_bits(std::span(&frame.judged.link.bytes[character], 1));
}

std::vector<bool> pin_bits(const OneFrame& frame, std::size_t character) {
  const FrameOnLine& place = frame.frame();
  std::vector<bool> bits;
  for (int slot = 0; slot < bits_per_byte; ++slot)
    bits.push_back(
        frame.line.wire.level_at(place.byte_start[character] + place.bit * (slot + 0.5)));
  return bits;
}

std::optional<BitPlace> first_difference(const OneFrame& frame) {
  for (std::size_t i = 0; i < frame.frame().byte_start.size(); ++i) {
    const std::vector<bool> sent = sent_bits(frame, i), seen = pin_bits(frame, i);
    for (std::size_t slot = 0; slot < sent.size(); ++slot)
      if (sent[slot] != seen[slot]) return BitPlace{i, static_cast<int>(slot)};
  }
  return std::nullopt;
}

std::string quoted(std::uint8_t byte) {
  const char c = static_cast<char>(byte);
  return "'" + escaped({&c, 1}) + "'";
}

std::string place_text(const OneFrame& frame, const BitPlace& place) {
  const std::string bit = place.slot == 0 ? "start bit"
                          : place.slot == protocol::stop_slot
                              ? "stop bit"
                              : fmt::format("data bit {}", place.slot - 1);
  return fmt::format("character {} {}, {}", place.character,
                     quoted(frame.judged.link.bytes[place.character]), bit);
}

}  // namespace sim
