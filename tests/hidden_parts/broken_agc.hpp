#pragma once
// A slow AGC that breaks the rule of channel/slow_agc.hpp in one way, or in none. A fit that knows
// the rule alone must say of such a part that it does not fit.
#include <cmath>

#include "channel/receiver_module.hpp"
#include "channel/slow_agc.hpp"
#include "dsp/exponential.hpp"
#include "dsp/lanes.hpp"
#include "dsp/units.hpp"
#include "hidden_part.hpp"

namespace hidden {

/// What is added to the rule's numbers. The defaults break nothing.
template <class T>
struct BrokenRuleOf {
  T steep_from = T(1e30f);   // dB from which on the attack is twice as fast
  T quick = T(0.0f);         // samples of release that are three times as fast, the first ones
  T short_share = T(0.0f);   // of a short burst's time that is charged
  T harsh_burst = T(1e30f);  // samples; a burst longer than that is charged more, whole
  T harsh_factor = T(1.0f);  // by that
  T linear = T(0.0f);        // share of the gain at rest that a sample takes; 0: attack in dB
};
using BrokenRule = BrokenRuleOf<float>;

template <class T>
void set_lane(BrokenRuleOf<T>& all, int lane, const BrokenRule& one) {
  dsp::set_lane(all.steep_from, lane, one.steep_from);
  dsp::set_lane(all.quick, lane, one.quick);
  dsp::set_lane(all.short_share, lane, one.short_share);
  dsp::set_lane(all.harsh_burst, lane, one.harsh_burst);
  dsp::set_lane(all.harsh_factor, lane, one.harsh_factor);
  dsp::set_lane(all.linear, lane, one.linear);
}

/// Needs an attack, and long bursts that are shorter than 300 cycles.
BrokenRule broken_rule(Broken broken, const channel::ModuleData& module, dsp::Hertz sample_rate);

template <class T>
class BrokenAgc {
 public:
  BrokenAgc(const channel::SlowAgcDesignOf<T>& d, const BrokenRuleOf<T>& rule)
      : d_(d), rule_(rule), tick_(static_cast<float>(d.samples_per_tick)) {}

  /// One tick, as channel::SlowAgc has it.
  T operator()(T active) {
    const T zero(0.0f), idle = tick_ - active, gap = quiet_ + idle;
    quiet_ = dsp::choose(active > zero, idle, gap);
    const T before = dsp::choose(gap > d_.min_gap, zero, burst_);
    burst_ = before + active;
    const T up = risen(charged(before, active));
    const T down = dsp::fused(-d_.release, recovered(gap, idle), up);
    decibels_ = dsp::smaller(dsp::larger(down, zero), d_.range);
    return gain();
  }

 private:
  /// Samples that are charged for `active` ones behind so many of the same burst.
  T charged(T before, T active) const {
    const T burst = before + active;
    const T turned_long = burst - d_.free - rule_.short_share * before;
    const T turned_harsh = rule_.harsh_factor * (burst - d_.free) - (before - d_.free);
    const T as_long = dsp::choose(before > d_.long_burst, active, turned_long);
    const T as_harsh =
        dsp::choose(before > rule_.harsh_burst, rule_.harsh_factor * active, turned_harsh);
    return dsp::choose(burst > rule_.harsh_burst, as_harsh,
                       dsp::choose(burst > d_.long_burst, as_long, rule_.short_share * active));
  }

  /// Samples of release, those of the quick one counted three times.
  T recovered(T gap, T idle) const {
    const T zero(0.0f), released = dsp::larger(gap - d_.hold, zero);
    const T now = dsp::smaller(released, idle);
    const T quick = dsp::smaller(dsp::larger(rule_.quick - (released - now), zero), now);
    return now + T(2.0f) * quick;
  }

  /// Decibels behind the attack.
  T risen(T charged) const {
    const T attack = dsp::choose(decibels_ > rule_.steep_from, d_.attack + d_.attack, d_.attack);
    const T in_db = dsp::fused(attack, charged, decibels_);
    const dsp::Mask<T> linear = rule_.linear > T(0.0f);
    if (!dsp::any(linear)) return in_db;
    // Of the gain's amplitude that is left; all of it may go, infinite dB before the range's end.
    const T share = dsp::smaller(rule_.linear * charged * gain(), T(1.0f));
    return dsp::choose(linear, decibels_ + lost_decibels(share), in_db);
  }

  /// Decibels by which an amplitude falls that loses a share of itself.
  static T lost_decibels(T share) {
    constexpr float decibels_of_e = 8.685889638065036f;  // 20 / ln(10)
    T decibels(0.0f);
    for (int i = 0; i < dsp::lanes<T>; ++i)
      dsp::set_lane(decibels, i, -decibels_of_e * std::log1p(-dsp::lane(share, i)));
    return decibels;
  }

  /// The factor on the threshold.
  T gain() const {
    constexpr float log2_of_one_decibel = 0.16609640474436813f;  // log2(10) / 20
    return dsp::power_of_two(decibels_ * T(log2_of_one_decibel));
  }

  channel::SlowAgcDesignOf<T> d_;
  BrokenRuleOf<T> rule_;
  T tick_;                // samples
  T burst_ = T(0.0f);     // samples of activity since the last gap
  T quiet_ = T(0.0f);     // samples without, since the last activity
  T decibels_ = T(0.0f);  // by which the threshold is raised
};

}  // namespace hidden
