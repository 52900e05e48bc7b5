#include "sim/trace/traced_message.hpp"

#include <algorithm>
#include <cmath>

#include "sim/text/escaped_text.hpp"

namespace sim {
namespace {

using protocol::UartByte;

std::vector<UartByte> last_message(const std::vector<UartByte>& bytes, double character_s) {
  std::size_t first = bytes.size();
  while (first > 0 && (first == bytes.size() ||
                       (bytes[first].start - bytes[first - 1].start).value < 1.5 * character_s))
    --first;
  return {bytes.begin() + static_cast<std::ptrdiff_t>(first), bytes.end()};
}

}  // namespace

std::optional<std::size_t> TracedMessage::place_of(const UartByte& read) const {
  for (std::size_t i = 0; i < sent.size(); ++i)
    if (std::abs((read.start - sent[i].start).value) < character_s / 2) return i;
  return std::nullopt;
}

bool TracedMessage::is_as_sent(const UartByte& read) const {
  const auto place = place_of(read);
  return place && !read.framing_error && sent[*place].value == read.value;
}

std::optional<std::size_t> TracedMessage::first_wrong() const {
  for (std::size_t i = 0; i < sent.size(); ++i)
    if (std::ranges::none_of(received, [&](const UartByte& read) {
          return place_of(read) == i && is_as_sent(read);
        }))
      return i;
  return std::nullopt;
}

bool is_wrong_at_pin(const TracedTrial& trial, const TracedMessage& message, std::size_t character,
                     int slot) {
  const double bit_s = message.character_s / protocol::bits_per_byte;
  const dsp::Seconds middle(message.start_s(character) + (slot + 0.5) * bit_s);
  return message.line.level_at(middle + trial.delay) !=
         protocol::line_bit(message.sent[character].value, slot);
}

TracedMessage message_of(const TracedTrial& trial) {
  const double character_s = protocol::bits_per_byte / trial.baud.value;
  TracedMessage message{
      .sent = last_message(protocol::receive_mid_bit(sent_line(trial), trial.baud), character_s),
      .received = {},
      .character_s = character_s,
      .line = read_line(trial)};
  message.received = protocol::receive_mid_bit(message.line, trial.baud);
  return message;
}

std::string shown(const UartByte& byte) {
  const char c = static_cast<char>(byte.value);
  const std::string text = c == ' ' ? "\u2423" : c == '\n' ? "\\n" : escaped({&c, 1});
  return text + (byte.framing_error ? "!" : "");
}

}  // namespace sim
