#pragma once
// The light of a stretch of wire: where a receiver module's output is low. Pulses are in order and
// do not touch.
#include <cstddef>
#include <span>
#include <vector>

#include "dsp/units.hpp"

namespace protocol {

struct LightPulse {
  dsp::Seconds fall, rise;

  dsp::Seconds length() const { return rise - fall; }
};

/// How long there was light until a time that does not decrease from question to question.
class LightMeasure {
 public:
  /// From the beginning of pulse `first` on.
  explicit LightMeasure(std::span<const LightPulse> pulses, std::size_t first = 0)
      : pulses_(pulses), next_(first) {}

  dsp::Seconds until(dsp::Seconds t) {
    while (next_ < pulses_.size() && pulses_[next_].rise <= t) whole_ += pulses_[next_++].length();
    if (next_ == pulses_.size() || pulses_[next_].fall >= t) return whole_;
    return whole_ + (t - pulses_[next_].fall);
  }

 private:
  std::span<const LightPulse> pulses_;
  std::size_t next_;       // first that does not end before the last time asked
  dsp::Seconds whole_{0};  // of those before it
};

}  // namespace protocol
