#pragma once
// From band-pass output to pin: comparator with a threshold that follows the peak (ATC), up/down
// integrator, Schmitt output. Structure: Temic U2538B ("the comparator with the higher threshold
// controls the integrator"); without the follower a 10^5 overdrive would stretch pulses by 37
// cycles and break the +6 cycle window of Vishay 82459 Fig. 1.
#include "dsp/lanes.hpp"

namespace channel {

/// Fast per-telegram threshold: a fraction of the tracked peak.
template <class T>
class PeakFollower {
 public:
  PeakFollower(T fraction, T decay_per_sample) : fraction_(fraction), decay_(decay_per_sample) {}

  T operator()(T u) {
    peak_ = dsp::larger(u, peak_ * decay_);
    return fraction_ * peak_;
  }

 private:
  T fraction_, decay_;
  T peak_ = T(0.0f);
};

/// A comparator pulse a carrier cycle becomes one level: it holds for a bit more than a cycle.
template <class T>
class PulseHold {
 public:
  explicit PulseHold(T samples) : samples_(samples) {}

  /// The share of this sample that the level lasts, 0 to 1: a hold need not be whole samples.
  T operator()(dsp::Mask<T> pulse) {
    left_ = dsp::choose(pulse, samples_, left_ - T(1.0f));
    return dsp::smaller(dsp::larger(left_, T(0.0f)), T(1.0f));
  }

 private:
  T samples_;
  T left_ = T(0.0f);
};

/// Counts up in light and down in dark between two stops; the output switches at the stops.
template <class T>
class PulseIntegrator {
 public:
  explicit PulseIntegrator(T samples) : top_(samples) {}

  /// `light`: the lit share of the sample. True while the output reports light.
  dsp::Mask<T> operator()(T light) {
    const T change = dsp::fused(light, T(2.0f), T(-1.0f));
    level_ = dsp::smaller(dsp::larger(level_ + change, T(0.0f)), top_);
    output_ = dsp::choose(level_ >= top_, dsp::Mask<T>(true), output_ & (level_ > T(0.0f)));
    return output_;
  }
  T level() const { return level_; }

 private:
  T top_;
  T level_ = T(0.0f);
  dsp::Mask<T> output_ = dsp::Mask<T>(false);
};

}  // namespace channel
