#pragma once
// The slow AGC: raises the fixed threshold, linear in dB with time, while bursts are longer or gaps
// shorter than the part allows, and lets it down again in the dark. It is what kills most 600-baud
// links, and its constants are not published: attack is a parameter with bounds (Temic U2538B:
// "only if the duty cycle exceeds a specific value"; Vishay 82480 p. 5: "logarithmic").
//
// Rule: activity is one burst until a gap of min_gap ends it. A burst longer than long_burst counts
// whole: its time up to there is charged at once, the rest as it goes. So the duty that a train of
// long bursts can keep for ever is release / (attack + release), whatever the burst length, and
// trains of short bursts with long enough gaps are never charged: the two plateaus and the drop of
// Vishay 82459 Fig. 8.
//
// The gain moves once a tick, but activity is measured in shares of samples: when a burst begins
// and ends on the grid of ticks must not change what it is charged.
#include "dsp/exponential.hpp"
#include "dsp/lanes.hpp"

namespace channel {

struct SlowAgcDesign {
  float long_burst, min_gap;  // samples
  float attack, release;      // dB a sample
  float range;                // dB
  float margin;               // activity is seen down to this fraction of the threshold
  int samples_per_tick;       // at most one carrier cycle of f0
};

template <class T>
class SlowAgc {
 public:
  explicit SlowAgc(const SlowAgcDesign& d)
      : long_burst_(d.long_burst),
        longest_(d.long_burst + 2.0f * static_cast<float>(d.samples_per_tick)),
        min_gap_(d.min_gap),
        attack_(d.attack),
        release_(d.release),
        range_(d.range),
        tick_(static_cast<float>(d.samples_per_tick)) {}

  /// One tick, of which `active` samples saw activity; returns the factor on the threshold, 1 or
  /// more.
  T operator()(T active) {
    const T zero(0.0f);
    const T idle = tick_ - active;
    const T gap = quiet_ + idle;
    quiet_ = dsp::choose(active > zero, idle, gap);
    const T before = dsp::choose(gap > min_gap_, zero, burst_);
    const T burst = before + active;
    const T charged =
        dsp::choose(burst > long_burst_, dsp::choose(before > long_burst_, active, burst), zero);
    burst_ = dsp::smaller(burst, longest_);
    const T risen = dsp::fused(attack_, charged, decibels_);
    decibels_ = dsp::smaller(dsp::larger(dsp::fused(-release_, idle, risen), zero), range_);
    return dsp::power_of_two(decibels_ * T(log2_of_one_decibel));
  }

 private:
  static constexpr float log2_of_one_decibel = 0.16609640474436813f;  // log2(10) / 20

  T long_burst_, longest_, min_gap_, attack_, release_, range_, tick_;
  T burst_ = T(0.0f);     // samples of activity since the last gap
  T quiet_ = T(0.0f);     // samples without, since the last activity
  T decibels_ = T(0.0f);  // by which the threshold is raised
};

}  // namespace channel
