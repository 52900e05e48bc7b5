#include "sim/guard/serial_line.hpp"

#include <algorithm>

namespace sim {

using dsp::Seconds;

void SerialLine::send(const protocol::Bytes& bytes, Seconds now) {
  const Seconds each = protocol::bits_per_byte * dsp::period(settings_.baud);
  Seconds at = std::max(now, free_at_);
  for (const std::uint8_t byte : bytes) {
    flying_.push_back({at, at + each, byte});
    at += each;
  }
  free_at_ = at;
}

SerialLine::Arrival SerialLine::take() {
  const Flight flight = flying_.front();
  flying_.pop_front();
  protocol::UartByte sent{.start = flight.start, .value = flight.value};
  protocol::UartByte byte = sent;
  if (damage_.uniform() < settings_.byte_error_ratio) {
    const auto bit = damage_.index(protocol::data_bits);
    byte.value = static_cast<std::uint8_t>(byte.value ^ (1U << bit));
  }
  return {sent, byte, outages_.has(flight.start)};
}

}  // namespace sim
