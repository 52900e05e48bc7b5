#pragma once
// SharedLink messages: `[:` destination source `|` field ... `|C` checksum `]` CR LF (Kairos
// Autonomi bulletin BUL-049). This is the format of one message; what nodes make of them is theirs.
// Whatever bytes come in, the decoder's memory is bounded, it names one outcome for every message
// that begins, and it starts afresh at the next `[`.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/uart.hpp"

namespace protocol {

/// Limit of a message in bytes, from `[` to LF.
inline constexpr std::size_t default_max_shared_link = 256;

/// Nodes 1 to 16.
constexpr bool is_address(char c) { return c >= 'A' && c <= 'P'; }

/// Sum of the characters, modulo 256; of a message from `:` to the letter C, both included.
std::uint8_t shared_link_checksum(std::string_view characters);

enum class SharedLinkFieldType : char {
  index = 'N',  // of the first value in the shared list
  data = 'D',   // a value; empty: it has not changed
  query = 'Q',  // name of the variable that is asked for
  reply = 'R',  // name of the variable whose value follows
};

struct SharedLinkField {
  SharedLinkFieldType type;
  std::string text;
  friend bool operator==(const SharedLinkField&, const SharedLinkField&) = default;
};

struct SharedLinkMessage {
  char destination = 'A', source = 'B';
  std::vector<SharedLinkField> fields;  // without the checksum, which belongs to the format
  friend bool operator==(const SharedLinkMessage&, const SharedLinkMessage&) = default;
};

/// A message as people write it, without what belongs to the format: "AB|N0|D40.1|D85.6".
std::string shared_link_text(const SharedLinkMessage& message);

/// The other way; why the text is no message, if it is none. Its characters are not looked at.
std::optional<std::string> parse_shared_link(std::string_view text, SharedLinkMessage& message);

/// Bytes on the line, from `[` to LF.
std::size_t shared_link_size(const SharedLinkMessage& message);

/// Why this text cannot be a value or a name, if it cannot.
std::optional<std::string> problem_in_text(std::string_view text);

/// Why this message cannot be sent, if it cannot.
std::optional<std::string> problem_in_message(const SharedLinkMessage& message,
                                              std::size_t max_size = default_max_shared_link);

/// The bytes on the line. The message must have no problem.
Bytes shared_link_encode(const SharedLinkMessage& message);

enum class SharedLinkOutcome {
  ok,
  unprintable,     // a byte outside 0x20..0x7E
  no_header,       // no colon behind the bracket
  bad_address,     // no two letters A to P and a field behind them
  no_checksum,     // the last field is no C
  not_hex,         // ... but not of two hex digits
  wrong_checksum,  // two hex digits, but not those of the message
  unknown_field,   // a letter other than N, D, Q, R, or C before the end
  overlong,        // no `]` within the limit
  unended,         // another `[` before the `]`
};

inline constexpr std::size_t shared_link_outcomes =
    static_cast<std::size_t>(SharedLinkOutcome::unended) + 1;

constexpr std::string_view name(SharedLinkOutcome outcome) {
  switch (outcome) {
    case SharedLinkOutcome::ok:
      return "ok";
    case SharedLinkOutcome::unprintable:
      return "unprintable";
    case SharedLinkOutcome::no_header:
      return "no_header";
    case SharedLinkOutcome::bad_address:
      return "bad_address";
    case SharedLinkOutcome::no_checksum:
      return "no_checksum";
    case SharedLinkOutcome::not_hex:
      return "not_hex";
    case SharedLinkOutcome::wrong_checksum:
      return "wrong_checksum";
    case SharedLinkOutcome::unknown_field:
      return "unknown_field";
    case SharedLinkOutcome::overlong:
      return "overlong";
    case SharedLinkOutcome::unended:
      return "unended";
  }
  return "";
}

struct SharedLinkFrame {
  SharedLinkOutcome outcome = SharedLinkOutcome::ok;
  SharedLinkMessage message{};  // if ok
  std::string text{};           // as received between the brackets, up to the limit
  dsp::Seconds start{};         // of the bracket
};

/// Feed it every byte heard; what is outside of brackets means nothing. A byte with a framing error
/// counts by its value: the checksum judges.
class SharedLinkDecoder {
 public:
  explicit SharedLinkDecoder(std::size_t max_size = default_max_shared_link);

  /// The message that this byte ends, if it does: well, badly, or by beginning another.
  std::optional<SharedLinkFrame> push(const UartByte& byte);

  /// The message that has begun and not ended, as received behind its bracket; nullptr if none has.
  const std::string* pending() const { return inside_ ? &text_ : nullptr; }

 private:
  SharedLinkFrame take(SharedLinkOutcome outcome);

  std::size_t longest_text_;
  bool inside_ = false;
  std::string text_;
  dsp::Seconds start_;
};

}  // namespace protocol
