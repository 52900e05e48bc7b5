#pragma once
// UART characters on a wire: 8N1, least significant bit first, idle 1 (COSYS "standard 600 baud").
// Receivers read a LogicTrace with a clock of their own. Every one of them reports a byte only if
// its stop bit was observed as far as it looks at it, and needs a 1-to-0 change to start: a wire
// that stays low says nothing.
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "dsp/logic_trace.hpp"
#include "dsp/units.hpp"

namespace protocol {

using Bytes = std::vector<std::uint8_t>;

inline constexpr int data_bits = 8;
inline constexpr int bits_per_byte = data_bits + 2;  // on the line: start, data, stop
inline constexpr int stop_slot = bits_per_byte - 1;

/// Level of the line in bit slot 0..9 of a character: start 0, data, stop 1.
constexpr bool line_bit(std::uint8_t byte, int slot) {
  assert(slot >= 0 && slot < bits_per_byte);
  const unsigned character = (1U << stop_slot) | (unsigned{byte} << 1U);
  return ((character >> slot) & 1U) != 0;
}

/// Levels of all slots of a message's characters, one after the other.
std::vector<bool> line_bits(std::span<const std::uint8_t> bytes);

/// Appends one character whose start bit begins at `start` and returns the end of its stop bit.
/// `baud` is the sender's true rate, its clock error included.
dsp::Seconds send_byte(dsp::LogicTrace& line, std::uint8_t byte, dsp::Seconds start,
                       dsp::Hertz baud);

struct UartByte {
  dsp::Seconds start;  // where the receiver saw the start bit begin
  std::uint8_t value = 0;
  bool framing_error = false;  // the stop bit was read as 0

  bool operator==(const UartByte&) const = default;
};

/// The first instant after t: falls are looked for strictly after what was read last.
inline dsp::Seconds just_after(dsp::Seconds t) {
  return dsp::Seconds(std::nextafter(t.value, std::numeric_limits<double>::infinity()));
}

/// The rule of sigrok's uart decoder (libsigrokdecode 0.5.3, uart/pd.py) in continuous time: a fall
/// starts a character, each bit is one sample at its middle, and the next fall is looked for
/// strictly after the last sample. sigrok says "Frame error" twice: for a stop bit that is low
/// (here a byte with framing_error) and for a start bit that is high at its middle. The latter
/// yields no byte there nor here; the instants of those falls are added to `false_starts`, so that
/// tests can compare every one of them with sigrok's.
std::vector<UartByte> receive_mid_bit(const dsp::LogicTrace& line, dsp::Hertz baud,
                                      std::vector<dsp::Seconds>* false_starts = nullptr);

/// The ATmega USART at normal speed: 16 samples a bit from a free-running clock, whose ticks fall
/// `clock_phase` of a tick (0 <= clock_phase < 1) after time 0; each bit is the majority of its
/// samples 8, 9 and 10. `start` is the first low sample, at most one tick after the edge.
std::vector<UartByte> receive_atmega(const dsp::LogicTrace& line, dsp::Hertz baud,
                                     double clock_phase = 0);

/// What a receiver makes of a wire so far.
struct UartReading {
  std::vector<UartByte> bytes;
  /// The rest of a wire from here on, and the level here, tell all that is not in `bytes` yet.
  dsp::Seconds settled{-std::numeric_limits<double>::infinity()};
};

/// The two receivers above.
UartReading read_mid_bit(const dsp::LogicTrace& line, dsp::Hertz baud);
UartReading read_atmega(const dsp::LogicTrace& line, dsp::Hertz baud, double clock_phase);

}  // namespace protocol
