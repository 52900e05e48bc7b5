#pragma once
// The message that a trial is about, its last: its characters as sent, and what a receiver that
// samples in the middle of each bit reads of the pin.
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "protocol/uart.hpp"
#include "sim/trace/trace.hpp"

namespace sim {

struct TracedMessage {
  std::vector<protocol::UartByte> sent;      // the last characters without a pause between them
  std::vector<protocol::UartByte> received;  // of the whole trial
  double character_s = 0;                    // of ten bits
  dsp::LogicTrace line{};                    // that the receiver reads

  double start_s(std::size_t character) const { return sent[character].start.value; }
  double end_s() const { return sent.back().start.value + character_s; }

  /// The character that was read at this place on the wire, if any.
  std::optional<std::size_t> place_of(const protocol::UartByte& read) const;
  bool is_as_sent(const protocol::UartByte& read) const;
  /// The first character that was not read as it was sent.
  std::optional<std::size_t> first_wrong() const;
};

/// Whether the line has not the level of a bit (0: the start bit) of a character in its middle.
bool is_wrong_at_pin(const TracedTrial& trial, const TracedMessage& message, std::size_t character,
                     int slot);

TracedMessage message_of(const TracedTrial& trial);

/// A character for people: a space as one that is seen, "!" behind one without its stop bit.
std::string shown(const protocol::UartByte& byte);

}  // namespace sim
