#pragma once
// channel::ReceiverModule with a BrokenAgc in place of its slow AGC. All else is the channel's.
#include "broken_agc.hpp"
#include "channel/band_pass.hpp"
#include "channel/demodulator.hpp"
#include "channel/receiver_module.hpp"
#include "dsp/lanes.hpp"

namespace hidden {

template <class T>
class BrokenModule {
 public:
  BrokenModule(const channel::ModuleDesignOf<T>& d, const BrokenRuleOf<T>& rule)
      : d_(d),
        to_tick_(d.agc.samples_per_tick),
        band_pass_(d.band_pass),
        follower_(d.atc_fraction, d.atc_decay),
        signal_(d.demodulator),
        activity_(d.demodulator),
        integrator_(d.demodulator),
        agc_(d.agc, rule) {
    set_gain(T(1.0f));
  }

  /// The two steps of a sample, as channel::ReceiverModule has them.
  T filtered(T irradiance) {
    light_ = dsp::fused(d_.front_end, irradiance - light_, light_);
    band_pass_(dsp::smaller(dsp::larger(light_, -d_.limit), d_.limit));
    return band_pass_.peak();
  }
  dsp::Mask<T> demodulated(T peak) {
    const T following = follower_(peak);
    active_ = active_ + activity_(peak > dsp::larger(sensed_, following));
    const T level = dsp::larger(fixed_, following);
    if (--to_tick_ == 0) tick();
    return !integrator_(signal_(peak > level));
  }

 private:
  void tick() {
    to_tick_ = d_.agc.samples_per_tick;
    set_gain(agc_(dsp::to_float(active_) * d_.demodulator.part));
    active_ = dsp::Words<T>(0u);
  }

  void set_gain(T gain) {
    fixed_ = d_.threshold * gain;
    sensed_ = fixed_ * d_.agc.margin;
  }

  channel::ModuleDesignOf<T> d_;
  T light_ = T(0.0f);                         // what the front end makes of the irradiance
  T fixed_, sensed_;                          // the fixed threshold; where activity begins
  dsp::Words<T> active_ = dsp::Words<T>(0u);  // activity since the last tick, in parts of a sample
  int to_tick_;
  channel::BandPass<T> band_pass_;
  channel::PeakFollower<T> follower_;
  channel::PulseHold<T> signal_, activity_;
  channel::PulseIntegrator<T> integrator_;
  BrokenAgc<T> agc_;
};

}  // namespace hidden
