#pragma once
// The slow AGC: raises the fixed threshold, linear in dB with time, while bursts are longer or gaps
// shorter than the part allows, and lets it down again in the dark. It is what kills most 600-baud
// links, and its constants are not published: attack is a parameter with bounds (PHYSICS: Temic
// U2538B "only if the duty cycle exceeds a specific value"; Vishay 82480 p. 5 "logarithmic").
//
// Rule: activity is one burst until a gap of min_gap ends it. A burst longer than long_burst counts
// whole: its time up to there is charged at once, the rest as it goes. So the duty that a train of
// long bursts can keep for ever is release / (attack + release), whatever the burst length, and
// trains of short bursts with long enough gaps are never charged: the two plateaus and the drop of
// Vishay 82459 Fig. 8.
#include "dsp/lanes.hpp"

namespace channel {

struct SlowAgcDesign {
  float long_burst, min_gap;   // ticks
  float attack, release;       // factors on the threshold, a tick
  float attack_of_long_burst;  // attack to the power of long_burst
  float highest;               // largest factor
  float margin;                // activity is seen down to this fraction of the threshold
  int samples_per_tick;        // one carrier cycle of f0
};

template <class T>
class SlowAgc {
 public:
  explicit SlowAgc(const SlowAgcDesign& d)
      : long_burst_(d.long_burst),
        min_gap_(d.min_gap),
        attack_(d.attack),
        release_(d.release),
        attack_of_long_burst_(d.attack_of_long_burst),
        highest_(d.highest) {}

  /// One tick with or without activity; returns the factor on the threshold, 1 or more.
  T operator()(dsp::Mask<T> active) {
    const T one(1.0f);
    quiet_ = dsp::choose(active, T(0.0f), quiet_ + one);
    burst_ = dsp::choose(active, dsp::smaller(burst_ + one, long_burst_ + T(2.0f)), burst_);
    burst_ = dsp::choose(quiet_ > min_gap_, T(0.0f), burst_);
    const dsp::Mask<T> charged = active & (burst_ > long_burst_);
    const dsp::Mask<T> first = charged & (burst_ <= long_burst_ + one);
    const T up = dsp::choose(first, attack_of_long_burst_, attack_);
    const T factor = dsp::choose(charged, up, dsp::choose(active, one, release_));
    gain_ = dsp::smaller(dsp::larger(gain_ * factor, one), highest_);
    return gain_;
  }

 private:
  T long_burst_, min_gap_, attack_, release_, attack_of_long_burst_, highest_;
  T burst_ = T(0.0f);  // ticks of activity since the last gap
  T quiet_ = T(0.0f);  // ticks without
  T gain_ = T(1.0f);
};

}  // namespace channel
