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
// Vishay 82459 Fig. 8. A part may spare the first cycles of a long burst (82491 Fig. 8, AGC4). A
// part that asks for one gap, however long the burst (AGC5, AGC6: Vishay
// 81762, 82836 Fig. 8), holds its gain for so long before it lets it down.
//
// The gain moves once a tick, but activity is measured in shares of samples: when a burst begins
// and ends on the grid of ticks must not change what it is charged.
#include "dsp/exponential.hpp"
#include "dsp/lanes.hpp"

namespace channel {

template <class T>
struct SlowAgcDesignOf {
  T long_burst, min_gap;  // samples
  T free;                 // samples of a long burst that are not charged
  T hold;                 // dark samples before the gain comes back
  T attack, release;      // dB a sample
  T range;                // dB
  T margin;               // activity is seen down to this fraction of the threshold
  int samples_per_tick;   // about a carrier cycle of f0, the same in all lanes
};
using SlowAgcDesign = SlowAgcDesignOf<float>;

template <class T>
void set_lane(SlowAgcDesignOf<T>& all, int lane, const SlowAgcDesign& one) {
  dsp::set_lane(all.long_burst, lane, one.long_burst);
  dsp::set_lane(all.min_gap, lane, one.min_gap);
  dsp::set_lane(all.free, lane, one.free);
  dsp::set_lane(all.hold, lane, one.hold);
  dsp::set_lane(all.attack, lane, one.attack);
  dsp::set_lane(all.release, lane, one.release);
  dsp::set_lane(all.range, lane, one.range);
  dsp::set_lane(all.margin, lane, one.margin);
  all.samples_per_tick = one.samples_per_tick;
}

template <class T>
class SlowAgc {
 public:
  explicit SlowAgc(const SlowAgcDesignOf<T>& d)
      : d_(d),
        tick_(static_cast<float>(d.samples_per_tick)),
        longest_(d.long_burst + tick_ + tick_) {}

  /// One tick, of which `active` samples saw activity; returns the factor on the threshold, 1 or
  /// more.
  T operator()(T active) {
    const T zero(0.0f);
    const T idle = tick_ - active;
    const T gap = quiet_ + idle;
    quiet_ = dsp::choose(active > zero, idle, gap);
    const T before = dsp::choose(gap > d_.min_gap, zero, burst_);
    const T burst = before + active;
    const T charged = dsp::choose(
        burst > d_.long_burst, dsp::choose(before > d_.long_burst, active, burst - d_.free), zero);
    burst_ = dsp::smaller(burst, longest_);
    const T recovered = dsp::smaller(dsp::larger(gap - d_.hold, zero), idle);
    const T risen = dsp::fused(d_.attack, charged, decibels_);
    const T was = decibels_;
    decibels_ =
        dsp::smaller(dsp::larger(dsp::fused(-d_.release, recovered, risen), zero), d_.range);
    change_ = decibels_ - was;
    return gain(decibels_);
  }

  /// The factor that share of a tick later, if it goes on as in the last one.
  T ahead(float share) const {
    return gain(dsp::larger(dsp::fused(T(share), change_, decibels_), T(0.0f)));
  }

  /// Dark samples, any number: the gain comes back, but not below `least` decibels unless it was
  /// there before; returns the factor.
  T rest(T samples, T least) {
    quiet_ = quiet_ + samples;
    burst_ = dsp::choose(quiet_ > d_.min_gap, T(0.0f), burst_);
    const T recovered = dsp::smaller(dsp::larger(quiet_ - d_.hold, T(0.0f)), samples);
    const T fallen = dsp::fused(-d_.release, recovered, decibels_);
    decibels_ = dsp::larger(fallen, dsp::smaller(decibels_, least));
    change_ = T(0.0f);
    return gain(decibels_);
  }

 private:
  static T gain(T decibels) { return dsp::power_of_two(decibels * T(log2_of_one_decibel)); }

  static constexpr float log2_of_one_decibel = 0.16609640474436813f;  // log2(10) / 20

  SlowAgcDesignOf<T> d_;
  T tick_, longest_;      // samples
  T burst_ = T(0.0f);     // samples of activity since the last gap
  T quiet_ = T(0.0f);     // samples without, since the last activity
  T change_ = T(0.0f);    // in the last tick, dB
  T decibels_ = T(0.0f);  // by which the threshold is raised
};

}  // namespace channel
