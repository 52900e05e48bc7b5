#include "protocol/uart_receivers.hpp"

#include <algorithm>
#include <array>

#include "protocol/edge_timing.hpp"
#include "protocol/software_serial.hpp"

namespace protocol {
namespace {

using dsp::Hertz;
using dsp::LogicTrace;

/// For those without a sampling clock.
template <UartReading (*read)(const LogicTrace&, Hertz)>
UartReading in_any_phase(const LogicTrace& line, Hertz baud, double) {
  return read(line, baud);
}

constexpr std::array receivers = {
    UartReceiver{"atmega", true, read_atmega},
    UartReceiver{"mid-bit", true, in_any_phase<read_mid_bit>},
    UartReceiver{"software-serial", false, in_any_phase<read_software_serial>},
    UartReceiver{"edge-timing", true, in_any_phase<read_edge_timing>},
};

}  // namespace

std::span<const UartReceiver> uart_receivers() { return receivers; }

const UartReceiver* find_uart_receiver(std::string_view name) {
  const auto* row = std::ranges::find(receivers, name, &UartReceiver::name);
  return row == receivers.end() ? nullptr : row;
}

}  // namespace protocol
