#include "protocol/uart_stream.hpp"

#include <utility>

namespace protocol {

void UartStream::forget_before(dsp::Seconds settled) {
  dsp::LogicTrace rest(part_.level_at(settled));
  for (const dsp::Seconds edge : part_.edges())
    if (edge > settled) rest.add_edge(edge);
  part_ = std::move(rest);
}

std::vector<UartByte> UartStream::take(const dsp::LogicTrace& wire) {
  const auto edges = wire.edges().subspan(next_edge_);
  next_edge_ += edges.size();
  return take(edges, wire.end());
}

std::vector<UartByte> UartStream::take(std::span<const dsp::Seconds> edges,
                                       dsp::Seconds known_until) {
  for (const dsp::Seconds edge : edges) part_.add_edge(edge);
  part_.observe_until(known_until);
  const UartReading reading = receiver_->read(part_, baud_, clock_phase_);
  forget_before(reading.settled);
  return reading.bytes;
}

}  // namespace protocol
