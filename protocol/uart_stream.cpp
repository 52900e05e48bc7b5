#include "protocol/uart_stream.hpp"

namespace protocol {

/// For two characters: no receiver is in the middle of one then.
bool UartStream::idle_before(dsp::Seconds flip) const {
  return part_.final_level() && !part_.flips().empty() &&
         flip - part_.flips().back() > 2 * bits_per_byte * dsp::period(baud_);
}

void UartStream::give(std::vector<UartByte>& bytes) {
  const std::vector<UartByte> all = receiver_->receive(part_, baud_, clock_phase_);
  bytes.insert(bytes.end(), all.begin() + static_cast<std::ptrdiff_t>(given_), all.end());
  given_ = all.size();
}

std::vector<UartByte> UartStream::take(const dsp::LogicTrace& wire) {
  std::vector<UartByte> bytes;
  for (; next_flip_ < wire.flips().size(); ++next_flip_) {
    const dsp::Seconds flip = wire.flips()[next_flip_];
    if (idle_before(flip)) {
      part_.observe_until(flip);
      give(bytes);
      part_ = dsp::LogicTrace(true);
      given_ = 0;
    }
    part_.flip_at(flip);
  }
  part_.observe_until(wire.end());
  give(bytes);
  return bytes;
}

}  // namespace protocol
