#pragma once
// A UART receiver that is read while its wire goes on: byte by byte what it makes of the whole
// wire.
#include <cstddef>
#include <span>
#include <vector>

#include "dsp/logic_trace.hpp"
#include "dsp/units.hpp"
#include "protocol/uart_receivers.hpp"

namespace protocol {

class UartStream {
 public:
  UartStream(const UartReceiver& receiver, dsp::Hertz baud, double clock_phase, bool initial = true)
      : receiver_(&receiver), baud_(baud), clock_phase_(clock_phase), part_(initial) {}

  /// Bytes that are whole in `wire`, an idle one that has grown since the last call, and were not
  /// given yet.
  std::vector<UartByte> take(const dsp::LogicTrace& wire);

  /// The same of a wire that nobody keeps: its edges since the last call, and until when it is
  /// known now. Memory is that of the edges since the last character.
  std::vector<UartByte> take(std::span<const dsp::Seconds> edges, dsp::Seconds known_until);

 private:
  void forget_before(dsp::Seconds settled);

  const UartReceiver* receiver_;
  dsp::Hertz baud_;
  double clock_phase_;
  std::size_t next_edge_ = 0;  // of the wire, not in the part yet
  dsp::LogicTrace part_;       // the wire since what was settled
};

}  // namespace protocol
