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

  /// Time in which nothing is higher: `share` is what it leaves of the peak.
  void rest(T share) { peak_ = peak_ * share; }

 private:
  T fraction_, decay_;
  T peak_ = T(0.0f);
};

/// Times behind the comparator are whole numbers of a small part of a sample: what waits for
/// itself from sample to sample then waits one cycle for each step, not four as a float does.
template <class T>
struct DemodulatorDesignOf {
  dsp::Words<T> sample;            // parts in a sample, a power of two
  T part;                          // samples in a part
  dsp::Words<T> hold, integrator;  // parts
};
using DemodulatorDesign = DemodulatorDesignOf<float>;

template <class T>
void set_lane(DemodulatorDesignOf<T>& all, int lane, const DemodulatorDesign& one) {
  dsp::set_lane(all.sample, lane, one.sample);
  dsp::set_lane(all.part, lane, one.part);
  dsp::set_lane(all.hold, lane, one.hold);
  dsp::set_lane(all.integrator, lane, one.integrator);
}

/// A comparator pulse a carrier cycle becomes one level: it holds for a bit more than a cycle.
template <class T>
class PulseHold {
 public:
  explicit PulseHold(const DemodulatorDesignOf<T>& d) : length_(d.hold), sample_(d.sample) {}

  /// The part of this sample that the level lasts: a hold need not be whole samples.
  dsp::Words<T> operator()(dsp::Mask<T> pulse) {
    left_ = dsp::larger_signed(left_ - sample_, dsp::kept(pulse, length_));
    return dsp::smaller_signed(left_, sample_);
  }

 private:
  dsp::Words<T> length_, sample_;
  dsp::Words<T> left_ = dsp::Words<T>(0u);
};

/// Counts up in light and down in dark between two stops; the output switches at the stops.
template <class T>
class PulseIntegrator {
 public:
  explicit PulseIntegrator(const DemodulatorDesignOf<T>& d)
      : top_(d.integrator),
        below_top_(d.integrator - dsp::Words<T>(1u)),
        sample_(d.sample),
        switch_(below_top_) {}

  /// `light`: the lit part of the sample. True while the output reports light.
  dsp::Mask<T> operator()(dsp::Words<T> light) {
    const dsp::Words<T> counted = level_ + (light + light - sample_);
    level_ = dsp::smaller_signed(dsp::larger_signed(counted, dsp::Words<T>(0u)), top_);
    const dsp::Mask<T> output = dsp::exceeds(level_, switch_);
    switch_ = dsp::kept(!output, below_top_);
    return output;
  }
  dsp::Words<T> level() const { return level_; }

 private:
  dsp::Words<T> top_, below_top_, sample_;
  dsp::Words<T> level_ = dsp::Words<T>(0u);
  dsp::Words<T> switch_;  // the output reports light above this level
};

}  // namespace channel
