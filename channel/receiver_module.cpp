#include "channel/receiver_module.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace channel {
namespace {

using std::numbers::pi;

double amplitude_ratio(double db) { return std::pow(10.0, db / 20.0); }

/// Ratio of Emin to the comparator's level, both as irradiance. A burst's envelope reaches the
/// level after -tau ln(1 - VT/E) and leaves it tau ln(E/VT) after its end (tau = Q/pi cycles); the
/// hold adds its length less the cycle that a comparator needs to see a peak. Solved for the pulse
/// width that defines Emin.
double emin_over_level(const ModuleData& data) {
  const double tau = data.q / pi;
  const double stretch = data.comparator_hold_cycles - 1.0;
  return 1.0 + std::exp((data.emin_width_cycles - stretch) / tau);
}

/// Band-pass amplitude of an on/off wave of 50 % duty at f0 and unit peak.
constexpr double fundamental = 2.0 / pi;

/// Output and integral of u' = (w0/Q)(x - u) - w0 v, v' = w0 u a time t later, x being constant:
/// exp(At) and A^-1 (exp(At) - 1) B.
std::pair<BandPassStep<float>, BandPassStep<float>> step_of(dsp::Hertz centre, double q, double t,
                                                            double droop) {
  const double w0 = 2 * pi * centre.value;
  const double decay = w0 / (2 * q);
  const double wd = w0 * std::sqrt(1 - 1 / (4 * q * q));
  const double e = std::exp(-decay * t), c = std::cos(wd * t), s = std::sin(wd * t) / wd;
  const double uu = e * (c - decay * s), vv = e * (c + decay * s), vu = e * w0 * s;
  const double ux = vu / q, vx = (1 - uu - vu / q) / q;
  const auto f = [](double x) { return static_cast<float>(x); };
  return {{f(uu), f(-vu), f(ux / droop)}, {f(vu), f(vv), f(vx / droop)}};
}

/// Gain of the front end's one pole, y += share (x - y), at a frequency in cycles a sample.
double front_end_gain(double share, double cycles) {
  const double keep = 1 - share;
  return share / std::sqrt(1 - 2 * keep * std::cos(2 * pi * cycles) + keep * keep);
}

/// Parts of a sample, so many that the longest time takes 30 bits.
DemodulatorDesign design_demodulator(const ModuleData& data, dsp::Hertz sample_rate) {
  const double cycle = sample_rate.value / data.centre_hz;
  const double hold = data.comparator_hold_cycles * cycle;
  const double integrator = data.integrator_cycles * cycle;
  const double longest = std::max({hold, integrator, cycle, 1.0});
  const double sample = std::exp2(std::min(16.0, std::floor(30 - std::log2(longest))));
  const auto parts = [&](double samples) {
    return static_cast<std::uint32_t>(std::lround(samples * sample));
  };
  return {.sample = parts(1),
          .part = static_cast<float>(1 / sample),
          .hold = parts(hold),
          .integrator = parts(integrator)};
}

}  // namespace

BandPassDesign design_band_pass(dsp::Hertz centre, double q, dsp::Hertz sample_rate,
                                double input_gain) {
  assert(q > 0.5 && sample_rate > 2.0 * centre);
  const double t = 1.0 / sample_rate.value;
  const double half = pi * centre.value * t;
  const double droop = std::sin(half) / half * input_gain;
  return {.output = step_of(centre, q, t, droop).first,
          .integral = step_of(centre, q, t, droop).second,
          .third = step_of(centre, q, t / 3, droop).first,
          .two_thirds = step_of(centre, q, t * 2 / 3, droop).first};
}

SlowAgcDesign design_slow_agc(const ModuleData& data, dsp::Hertz sample_rate) {
  const double cycle = sample_rate.value / data.centre_hz;
  const double attack = data.agc_attack_db_per_ms * 1e3 / sample_rate.value;
  const double duty = std::min(data.agc_max_duty, 0.999);
  const double release = attack * duty / (1.0 - duty);
  const double ms = sample_rate.value * 1e-3;
  const double long_burst =
      data.agc_long_burst_ms > 0 ? data.agc_long_burst_ms * ms : data.agc_long_burst_cycles * cycle;
  return {.long_burst = static_cast<float>(long_burst),
          .min_gap = static_cast<float>(data.agc_min_gap_cycles * cycle),
          .free = static_cast<float>(std::min(data.agc_free_cycles * cycle, long_burst)),
          .hold = static_cast<float>(data.agc_hold_ms * ms),
          .attack = static_cast<float>(attack),
          .release = static_cast<float>(release),
          .range = static_cast<float>(data.agc_range_db),
          .margin = static_cast<float>(amplitude_ratio(-data.agc_margin_db)),
          .samples_per_tick = std::max(1, static_cast<int>(cycle))};
}

double emin_in_ambient(const ModuleData& data, dsp::WattsPerSquareMetre ambient) {
  const double e = ambient.value;
  const double light = data.ambient_k * e * (1.0 + e / data.ambient_es_w_per_m2);
  return std::sqrt(data.emin_mw_per_m2 * data.emin_mw_per_m2 + light);
}

double comparator_level(const ModuleData& data, dsp::WattsPerSquareMetre ambient) {
  return fundamental * emin_in_ambient(data, ambient) / emin_over_level(data);
}

ModuleDesign design_module(const ModuleData& data, dsp::WattsPerSquareMetre ambient,
                           dsp::Hertz sample_rate) {
  const double atc_samples = data.atc_release_ms * 1e-3 * sample_rate.value;
  const double front_end = 1 - std::exp(-2 * pi * data.front_end_hz / sample_rate.value);
  return {
      .front_end = static_cast<float>(front_end),
      .band_pass = design_band_pass(dsp::Hertz(data.centre_hz), data.q, sample_rate,
                                    front_end_gain(front_end, data.centre_hz / sample_rate.value)),
      .limit = static_cast<float>(data.emax_w_per_m2 * 1e3),
      .threshold = static_cast<float>(comparator_level(data, ambient)),
      .atc_fraction = static_cast<float>(data.atc_fraction),
      .atc_decay = static_cast<float>(std::exp(-1.0 / atc_samples)),
      .demodulator = design_demodulator(data, sample_rate),
      .agc = design_slow_agc(data, sample_rate)};
}

dsp::Seconds nominal_delay(const ModuleData& data) {
  return dsp::Seconds((data.comparator_hold_cycles + data.integrator_cycles) / data.centre_hz);
}

}  // namespace channel
