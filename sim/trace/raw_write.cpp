#include "sim/trace/raw_write.hpp"

#include <cmath>

namespace sim {

std::string logic_samples(const TracedTrial& trial, std::size_t count, dsp::Hertz rate) {
  dsp::TraceReader tx(trial.tx), rx(trial.rx);
  std::string samples;
  samples.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const dsp::Seconds at(static_cast<double>(i) / rate.value);
    samples += static_cast<char>((tx.level_at(at) ? 1 : 0) | (rx.level_at(at) ? 2 : 0));
  }
  return samples;
}

std::string trace_as_raw(const TracedTrial& trial) {
  const double count = std::ceil(dsp::cycles(trial.tx.end(), logic_rate));
  return logic_samples(trial, static_cast<std::size_t>(count), logic_rate);
}

}  // namespace sim
