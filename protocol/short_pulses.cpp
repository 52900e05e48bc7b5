#include "protocol/short_pulses.hpp"

#include <algorithm>
#include <optional>

#include "protocol/uart.hpp"

namespace protocol {

using dsp::Hertz;
using dsp::LogicTrace;
using dsp::Seconds;

Seconds send_byte_in_pulses(LogicTrace& line, std::uint8_t byte, Seconds start, Hertz baud,
                            Seconds pulse) {
  if (pulse <= Seconds(0)) return send_byte(line, byte, start, baud);
  const Seconds bit = dsp::period(baud);
  for (int slot = 0; slot < bits_per_byte; ++slot) {
    const Seconds begin = start + slot * bit;
    line.set_at(begin, line_bit(byte, slot));
    if (!line_bit(byte, slot)) line.set_at(begin + std::min(pulse, bit), true);
  }
  const Seconds end = start + bits_per_byte * bit;
  line.observe_until(end);
  return end;
}

LogicTrace whole_bits(const LogicTrace& pin, Hertz baud) {
  const Seconds bit = dsp::period(baud);
  LogicTrace whole(pin.initial(), Seconds(0));
  bool level = pin.initial();
  std::optional<Seconds> low_until;  // of the spell that is not written yet
  for (const Seconds edge : pin.edges()) {
    level = !level;
    if (level) {
      low_until = low_until ? std::max(*low_until, edge) : edge;
      continue;
    }
    if (low_until && edge > *low_until) {
      whole.set_at(*low_until, true);
      low_until.reset();
    }
    if (!low_until) whole.set_at(edge, false);
    low_until = edge + bit;
  }
  if (low_until && level) whole.set_at(*low_until, true);
  whole.observe_until(pin.end());
  return whole;
}

}  // namespace protocol
