#include "sim/guard/serial_line.hpp"

#include <algorithm>
#include <cmath>

namespace sim {

using dsp::Seconds;

/// It may be out already, as at any other time.
SerialLine::SerialLine(const LineSettings& settings, const dsp::RandomAddress& draws)
    : settings_(settings), draws_(draws) {
  if (settings_.outage_every.value <= 0) return;
  const Seconds cycle = settings_.outage_every + settings_.outage_for;
  out_ = uniform() * cycle.value >= settings_.outage_for.value;  // flipped at once
}

void SerialLine::send(const protocol::Bytes& bytes, Seconds now) {
  const Seconds each = protocol::bits_per_byte * dsp::period(settings_.baud);
  Seconds at = std::max(now, free_at_);
  for (const std::uint8_t byte : bytes) {
    flying_.push_back({at, at + each, byte});
    at += each;
  }
  free_at_ = at;
}

/// Exponential spells.
bool SerialLine::out_at(Seconds t) {
  if (settings_.outage_every.value <= 0) return false;
  while (until_ <= t) {
    out_ = !out_;
    until_ += -std::log1p(-uniform()) * (out_ ? settings_.outage_for : settings_.outage_every);
  }
  return out_;
}

SerialLine::Arrival SerialLine::take() {
  const Flight flight = flying_.front();
  flying_.pop_front();
  protocol::UartByte sent{.start = flight.start, .value = flight.value};
  protocol::UartByte byte = sent;
  if (uniform() < settings_.byte_error_ratio) {
    const auto bit = static_cast<unsigned>(uniform() * protocol::data_bits);
    byte.value = static_cast<std::uint8_t>(byte.value ^ (1U << bit));
  }
  return {sent, byte, out_at(flight.start)};
}

}  // namespace sim
