#include "protocol/uart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace protocol {

using dsp::Hertz;
using dsp::LogicTrace;
using dsp::Seconds;

std::vector<bool> line_bits(std::span<const std::uint8_t> bytes) {
  std::vector<bool> levels;
  for (const std::uint8_t byte : bytes)
    for (int slot = 0; slot < bits_per_byte; ++slot) levels.push_back(line_bit(byte, slot));
  return levels;
}

Seconds send_byte(LogicTrace& line, std::uint8_t byte, Seconds start, Hertz baud) {
  const Seconds bit = dsp::period(baud);
  for (int slot = 0; slot < bits_per_byte; ++slot) {
    line.set_at(start + slot * bit, line_bit(byte, slot));
  }
  const Seconds end = start + bits_per_byte * bit;
  line.observe_until(end);
  return end;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The eight data bits, each read by `read_slot(slot)`, in the order of time.
template <class ReadSlot>
std::uint8_t read_data(const ReadSlot& read_slot) {
  unsigned value = 0;
  for (int bit = 0; bit < data_bits; ++bit) {
    value |= static_cast<unsigned>(read_slot(1 + bit)) << bit;
  }
  return static_cast<std::uint8_t>(value);
}

UartReading read_mid_bits(const LogicTrace& line, Hertz baud, std::vector<Seconds>* false_starts) {
  const Seconds bit = dsp::period(baud);
  UartReading reading;
  dsp::TraceReader reader(line);
  std::optional<Seconds> start = reader.next_fall(Seconds(-infinity));
  while (start) {
    const auto middle = [&](int slot) { return *start + (slot + 0.5) * bit; };
    const auto level = [&](int slot) { return reader.level_at(middle(slot)); };
    const bool false_start = level(0);
    const int last = false_start ? 0 : stop_slot;
    if (middle(last) > line.end()) break;
    if (!false_start) {
      const std::uint8_t value = read_data(level);
      reading.bytes.push_back({*start, value, !level(stop_slot)});
    } else if (false_starts != nullptr) {
      false_starts->push_back(*start);
    }
    reading.settled = middle(last);
    start = reader.next_fall(just_after(reading.settled));
  }
  return reading;
}

/// Data sheet ATmega328P, "Asynchronous data recovery": 16 samples a bit, numbered from 1; 8, 9 and
/// 10 vote. Ticks are counted in double, which is exact for any trace shorter than 2^53 ticks.
class AtmegaReceiver {
 public:
  AtmegaReceiver(const LogicTrace& line, Hertz baud, double clock_phase)
      : line_(line),
        falls_(line),
        votes_(line),
        tick_rate_(samples_per_bit * baud.value),
        phase_(clock_phase) {
    assert(clock_phase >= 0 && clock_phase < 1);
    assert(line.end().value * tick_rate_ < 0x1p53);
  }

  UartReading read() {
    UartReading reading;
    auto start = next_start(-1);  // before the first tick the wire has its initial level
    while (start && time(sample(*start, stop_slot, 10)) <= line_.end()) {
      int last = 0;
      if (!vote(*start, 0)) {
        reading.bytes.push_back(read_byte(*start));
        last = stop_slot;
      }
      reading.settled = time(sample(*start, last, 9));  // the tenth may see a fall from there
      start = start_from_last_vote(*start, last);
    }
    if (!start) reading.settled = std::max(reading.settled, last_tick());
    return reading;
  }

 private:
  static constexpr int samples_per_bit = 16;

  /// Tick of sample `number` (1..16) of a bit; sample 1 of the start bit is its first low sample.
  static double sample(double start, int slot, int number) {
    return start + samples_per_bit * slot + (number - 1);
  }
  /// The last tick that is surely known: a later fall is seen against the level there.
  Seconds last_tick() const {
    return time(std::floor(line_.end().value * tick_rate_ - phase_) - 1);
  }
  Seconds time(double tick) const { return Seconds((tick + phase_) / tick_rate_); }
  bool level(double tick) const { return line_.level_at(time(tick)); }
  bool falls_at(double tick) const { return level(tick - 1) && !level(tick); }

  bool vote(double start, int slot) {
    int high = 0;
    for (int number = 8; number <= 10; ++number)
      high += votes_.level_at(time(sample(start, slot, number)));
    return high >= 2;
  }

  UartByte read_byte(double start) {
    const auto value = read_data([&](int slot) { return vote(start, slot); });
    return {time(start), value, !vote(start, stop_slot)};
  }

  /// The data sheet's R_fast = (D+2)S / ((D+1)S + S_M) has the line high up to sample 9 only: the
  /// next start may already be low at sample 10, the last that votes.
  std::optional<double> start_from_last_vote(double start, int slot) {
    const double tenth = sample(start, slot, 10);
    return falls_at(tenth) ? tenth : next_start(tenth);
  }

  /// First tick after `tick` that samples low after a high sample. Jumps from fall to fall, since
  /// most of a line is silence; a fall that no two samples straddle is not seen, as in the device.
  std::optional<double> next_start(double tick) {
    while (const auto fall = falls_.next_fall(just_after(time(tick)))) {
      tick = std::max(tick + 1, std::floor(fall->value * tick_rate_ - phase_));
      if (falls_at(tick)) return tick;
    }
    return std::nullopt;
  }

  const LogicTrace& line_;
  dsp::TraceReader falls_;
  dsp::TraceReader votes_;
  double tick_rate_;
  double phase_;
};

}  // namespace

UartReading read_mid_bit(const LogicTrace& line, Hertz baud) {
  return read_mid_bits(line, baud, nullptr);
}

UartReading read_atmega(const LogicTrace& line, Hertz baud, double clock_phase) {
  return AtmegaReceiver(line, baud, clock_phase).read();
}

std::vector<UartByte> receive_mid_bit(const LogicTrace& line, Hertz baud,
                                      std::vector<Seconds>* false_starts) {
  return read_mid_bits(line, baud, false_starts).bytes;
}

std::vector<UartByte> receive_atmega(const LogicTrace& line, Hertz baud, double clock_phase) {
  return read_atmega(line, baud, clock_phase).bytes;
}

}  // namespace protocol
