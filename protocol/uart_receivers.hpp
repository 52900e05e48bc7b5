#pragma once
// The UART receivers that scenarios and decode can name, a row each.
#include <span>
#include <string_view>

#include "protocol/uart.hpp"

namespace protocol {

/// Those without a sampling clock ignore the phase.
struct UartReceiver {
  std::string_view name;
  bool reads_stop_bits;  // no framing errors without
  UartReading (*read)(const dsp::LogicTrace& line, dsp::Hertz baud, double clock_phase);

  std::vector<UartByte> receive(const dsp::LogicTrace& line, dsp::Hertz baud,
                                double clock_phase) const {
    return read(line, baud, clock_phase).bytes;
  }
};

std::span<const UartReceiver> uart_receivers();
/// nullptr if there is none of that name.
const UartReceiver* find_uart_receiver(std::string_view name);

}  // namespace protocol
