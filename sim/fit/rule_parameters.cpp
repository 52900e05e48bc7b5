#include "sim/fit/rule_parameters.hpp"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

bool is_logarithm(RuleParameter parameter) {
  switch (parameter) {
    case RuleParameter::centre:
    case RuleParameter::q:
    case RuleParameter::integrator:
    case RuleParameter::atc_release:
    case RuleParameter::attack:
    case RuleParameter::duty:
    case RuleParameter::long_burst:
    case RuleParameter::min_gap:
      return true;
    default:
      return false;
  }
}

/// Of a burst of which the output is as much shorter as Emin is defined by: it is above the level
/// from tau ln(1 / (1 - 1/r)) on to tau ln(r - 1 + 1) behind its end, tau = Q / pi cycles.
double emin_over_threshold(const channel::ModuleData& module) {
  const double tau_cycles = module.q / M_PI;
  const double stretch = module.comparator_hold_cycles - 1;
  return 1 + std::exp((module.emin_width_cycles - stretch) / tau_cycles);
}

}  // namespace

ParameterPriors parameter_priors(const channel::ModuleData& like, double carrier_hz) {
  const bool has_gain_control = like.agc_attack_db_per_ms > 0;
  const channel::ModuleData usual;
  const channel::ModuleData& gain = has_gain_control ? like : usual;
  const double long_cycles = gain.agc_long_burst_ms > 0
                                 ? gain.agc_long_burst_ms * 1e-3 * like.centre_hz
                                 : gain.agc_long_burst_cycles;
  return {{
      {"centre_hz", std::log(carrier_hz), 0.03, 0.002},
      {"q", std::log(like.q), 0.3, 0.03},
      {"emin_mw_per_m2", -50, 30, 0.2},  // its level, in dB over the first step's light
      {"integrator_cycles", std::log(like.integrator_cycles), 0.35, 0.04},
      {"comparator_hold_cycles", like.comparator_hold_cycles, 0.25, 0.1},
      {"atc_fraction", like.atc_fraction, 0.12, 0.03},
      {"atc_release_ms", std::log(like.atc_release_ms), 0.7, 0.1},
      {"agc_attack_db_per_ms", std::log(gain.agc_attack_db_per_ms), 1.2, 0.02},
      {"agc_max_duty", std::log(gain.agc_max_duty), 0.7, 0.02},
      {"agc_long_burst_cycles", std::log(long_cycles), 0.4, 0.02},
      {"agc_free_cycles", gain.agc_free_cycles, 12, 2, false, 0},
      {"agc_min_gap_cycles", std::log(std::max(gain.agc_min_gap_cycles, 4.0)), 0.7, 0.05},
      {"agc_hold_ms", gain.agc_hold_ms, 12, 0.6, false, 0},
      {"agc_margin_db", gain.agc_margin_db, 2.5, 0.3, false, 0},
      {"agc_range_db", gain.agc_range_db, 100, 1.5},
      {"", -2, 10, 0.1},  // where the plan begins and the integrator is full: carrier cycles
      {"", 0, 30, 1},     // parts in a million of the clock beside the alignment's
  }};
}

double value_of(RuleParameter parameter, double x) {
  if (is_logarithm(parameter)) return std::exp(x);
  switch (parameter) {
    case RuleParameter::threshold:
      return std::pow(10, x / 20);
    case RuleParameter::atc_fraction:
      return std::clamp(x, 0.0, 0.95);
    case RuleParameter::comparator_hold:
    case RuleParameter::free_cycles:
    case RuleParameter::dark_hold:
    case RuleParameter::margin:
      return std::max(x, 0.0);
    case RuleParameter::range:
      return std::clamp(x, 0.0, 200.0);
    default:
      return x;
  }
}

RuleConstants constants_of(const Numbers& x) {
  const auto value = [&](RuleParameter p) { return value_of(p, x[place_of(p)]); };
  RuleConstants c;
  c.centre_hz = value(RuleParameter::centre);
  const double cycle = 1 / c.centre_hz;
  c.q = std::max(value(RuleParameter::q), 0.6);
  c.threshold = value(RuleParameter::threshold);
  c.integrator_s = value(RuleParameter::integrator) * cycle;
  c.hold_s = value(RuleParameter::comparator_hold) * cycle;
  c.atc_fraction = value(RuleParameter::atc_fraction);
  c.atc_release_s = value(RuleParameter::atc_release) * 1e-3;
  c.attack_db_per_s = value(RuleParameter::attack) * 1e3;
  const double duty = std::min(value(RuleParameter::duty), 0.99);
  c.release_db_per_s = c.attack_db_per_s * duty / (1 - duty);
  c.long_burst_s = value(RuleParameter::long_burst) * cycle;
  c.free_s = std::min(value(RuleParameter::free_cycles) * cycle, c.long_burst_s);
  c.min_gap_s = value(RuleParameter::min_gap) * cycle;
  c.dark_hold_s = value(RuleParameter::dark_hold) * 1e-3;
  c.margin_db = value(RuleParameter::margin);
  c.range_db = value(RuleParameter::range);
  return c;
}

double start_cycles(const Numbers& x, std::size_t capture) {
  return x[place_of(CaptureNumber::start, capture)] -
         value_of(RuleParameter::integrator, x[place_of(RuleParameter::integrator)]);
}

channel::ModuleData module_of(const Numbers& x, const channel::ModuleData& like,
                              double first_level_mw_per_m2) {
  const auto value = [&](RuleParameter p) { return value_of(p, x[place_of(p)]); };
  channel::ModuleData module = like;
  module.centre_hz = value(RuleParameter::centre);
  module.q = value(RuleParameter::q);
  module.comparator_hold_cycles = value(RuleParameter::comparator_hold);
  module.integrator_cycles = value(RuleParameter::integrator);
  module.atc_fraction = value(RuleParameter::atc_fraction);
  module.atc_release_ms = value(RuleParameter::atc_release);
  module.agc_attack_db_per_ms = value(RuleParameter::attack);
  module.agc_max_duty = value(RuleParameter::duty);
  module.agc_long_burst_cycles = value(RuleParameter::long_burst);
  module.agc_long_burst_ms = 0;
  module.agc_free_cycles = value(RuleParameter::free_cycles);
  module.agc_min_gap_cycles = value(RuleParameter::min_gap);
  module.agc_hold_ms = value(RuleParameter::dark_hold);
  module.agc_margin_db = value(RuleParameter::margin);
  module.agc_range_db = value(RuleParameter::range);
  module.emin_mw_per_m2 =
      first_level_mw_per_m2 * value(RuleParameter::threshold) * emin_over_threshold(module);
  return module;
}

}  // namespace sim
