#include "broken_agc.hpp"

namespace hidden {

BrokenRule broken_rule(Broken broken, const channel::ModuleData& module, dsp::Hertz sample_rate) {
  const channel::SlowAgcDesign agc = channel::design_slow_agc(module, sample_rate);
  const double cycle = sample_rate.value / module.centre_hz;
  BrokenRule rule;
  switch (broken) {
    case Broken::nothing:
      break;
    case Broken::steep_attack:
      rule.steep_from = 20;
      break;
    case Broken::two_releases:
      rule.quick = static_cast<float>(10e-3 * sample_rate.value);
      break;
    case Broken::charged_short_bursts:
      rule.short_share = 0.2f;
      break;
    case Broken::harsh_long_bursts:  // half of release / (attack + release)
      rule.harsh_burst = static_cast<float>(300 * cycle);
      rule.harsh_factor = 2 + agc.release / agc.attack;
      break;
    case Broken::linear_attack:  // a gain of 1 is 0.1 after as long as 20 dB take
      rule.linear = 0.9f * agc.attack / 20;
      break;
  }
  return rule;
}

}  // namespace hidden
