#include "protocol/uart_stream.hpp"

#include <utility>

namespace protocol {

void UartStream::forget_before(dsp::Seconds settled) {
  dsp::LogicTrace rest(part_.level_at(settled));
  for (const dsp::Seconds flip : part_.flips())
    if (flip > settled) rest.flip_at(flip);
  part_ = std::move(rest);
}

std::vector<UartByte> UartStream::take(const dsp::LogicTrace& wire) {
  for (; next_flip_ < wire.flips().size(); ++next_flip_) part_.flip_at(wire.flips()[next_flip_]);
  part_.observe_until(wire.end());
  const UartReading reading = receiver_->read(part_, baud_, clock_phase_);
  forget_before(reading.settled);
  return reading.bytes;
}

}  // namespace protocol
