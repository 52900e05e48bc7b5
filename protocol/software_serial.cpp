#include "protocol/software_serial.hpp"

#include <cmath>

namespace protocol {
namespace {

using dsp::Seconds;

constexpr double cpu_hz = 16e6;

Seconds cycles(int n) { return Seconds(n / cpu_hz); }

int delay_less(int delay, int instructions) {
  const int units = instructions / 4;
  return delay > units ? delay - units : 1;
}

/// From a fall to the first data bit, from one data bit to the next, from the last until the next
/// fall is seen.
struct Timing {
  Seconds first_bit, bit, listening;
};

Timing timing_of(dsp::Hertz baud) {
  const int bit_delay = static_cast<int>(cpu_hz / baud.value) / 4;
  const int within_bits = delay_less(bit_delay, 23);
  const int centring = delay_less(bit_delay / 2, 4 + 4 + 75 + 17 - 23);
  const int stop_bit = delay_less(bit_delay * 3 / 4, 37 + 11);
  return {.first_bit = cycles(4 + 4 + 75 + 4 * centring + 17 + 4 * within_bits),
          .bit = cycles(4 * within_bits + 23),
          .listening = cycles(37 + 4 * stop_bit + 11)};
}

}  // namespace

UartReading read_software_serial(const dsp::LogicTrace& line, dsp::Hertz baud) {
  const Timing timing = timing_of(baud);
  const Seconds entered = cycles(4 + 4 + 75);
  UartReading reading;
  dsp::TraceReader reader(line);
  auto start = reader.next_fall(Seconds(-INFINITY));
  for (; start; start = reader.next_fall(just_after(reading.settled))) {
    const Seconds first = *start + timing.first_bit;
    const Seconds listens = first + (data_bits - 1) * timing.bit + timing.listening;
    if (listens > line.end()) break;
    if (reader.level_at(*start + entered)) {  // gone already
      reading.settled = *start + entered;
      continue;
    }
    unsigned value = 0;
    for (int i = 0; i < data_bits; ++i)
      value |= static_cast<unsigned>(reader.level_at(first + i * timing.bit)) << i;
    reading.bytes.push_back({.start = *start, .value = static_cast<std::uint8_t>(value)});
    reading.settled = listens;
  }
  return reading;
}

}  // namespace protocol
