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
  const auto flips = wire.flips().subspan(next_flip_);
  next_flip_ += flips.size();
  return take(flips, wire.end());
}

std::vector<UartByte> UartStream::take(std::span<const dsp::Seconds> flips,
                                       dsp::Seconds known_until) {
  for (const dsp::Seconds flip : flips) part_.flip_at(flip);
  part_.observe_until(known_until);
  const UartReading reading = receiver_->read(part_, baud_, clock_phase_);
  forget_before(reading.settled);
  return reading.bytes;
}

}  // namespace protocol
