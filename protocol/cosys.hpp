#pragma once
// COSYS messages: `<device message> <2 hex digits>\n`, the digits being the XOR of the device
// message (COSYS protocol, January 22, 2025). Whatever bytes come in, the decoder's memory is
// bounded, it names one outcome for every line that ends or outgrows the limit, and it starts
// afresh after the next newline.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/uart.hpp"

namespace protocol {

/// Limit of a line in bytes, newline included.
inline constexpr std::size_t default_max_line = 256;

/// What a line has behind the device message: space, two hex digits, newline.
inline constexpr std::size_t tail_size = 4;

/// Longest device message that fits into such a line, in bytes.
inline constexpr std::size_t longest_message = default_max_line - tail_size;

/// XOR of all bytes, the separating space not among them.
std::uint8_t cosys_checksum(std::string_view device_message);

/// Why this message cannot be sent, if it cannot.
std::optional<std::string> problem_in_message(std::string_view device_message,
                                              std::size_t max_line = default_max_line);

/// The bytes on the line. The message must have no problem.
Bytes cosys_encode(std::string_view device_message);

enum class CosysOutcome {
  ok,
  unprintable,     // a byte outside 0x20..0x7E anywhere before the newline
  too_short,       // no space followed by at least two characters: no room for a checksum
  not_hex,         // what follows the last space is not exactly two hex digits
  wrong_checksum,  // two hex digits, but not those of the message
  overlong,        // no newline within the limit
};

constexpr std::string_view name(CosysOutcome outcome) {
  switch (outcome) {
    case CosysOutcome::ok:
      return "ok";
    case CosysOutcome::unprintable:
      return "unprintable";
    case CosysOutcome::too_short:
      return "too_short";
    case CosysOutcome::not_hex:
      return "not_hex";
    case CosysOutcome::wrong_checksum:
      return "wrong_checksum";
    case CosysOutcome::overlong:
      return "overlong";
  }
  return "";
}

struct CosysFrame {
  CosysOutcome outcome = CosysOutcome::ok;
  std::string message;  // the device message if ok, else the line as received up to the limit
  dsp::Seconds start;   // of the line's first byte
};

/// Feed it every byte heard. A byte with a framing error counts by its value: the checksum judges.
class CosysDecoder {
 public:
  explicit CosysDecoder(std::size_t max_line = default_max_line);

  /// The frame that this byte completes, if it does. An overlong line is reported once, at the byte
  /// that leaves no room for the newline; the rest of it is dropped up to and with its newline.
  std::optional<CosysFrame> push(const UartByte& byte);

  /// The line that has begun and not ended, as received so far; empty if there is none.
  const std::string& pending() const { return line_; }

 private:
  CosysFrame take_line(CosysOutcome outcome);

  std::size_t max_line_;
  std::string line_;
  dsp::Seconds start_;
  bool dropping_ = false;  // inside the rest of an overlong line
};

}  // namespace protocol
