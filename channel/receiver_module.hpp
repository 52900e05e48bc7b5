#pragma once
// A receiver module (TSOP-like). ModuleData is the part as its data sheet says it (one TOML file a
// part); ModuleDesign the same turned into numbers per sample; ReceiverModule<T> the stages at
// work: limiter, band-pass, comparator at max(fixed threshold, fraction of peak), integrator,
// Schmitt.
#include <string>

#include "channel/band_pass.hpp"
#include "channel/curve.hpp"
#include "channel/demodulator.hpp"
#include "channel/number_bounds.hpp"
#include "channel/slow_agc.hpp"
#include "dsp/lanes.hpp"
#include "dsp/units.hpp"

namespace channel {

struct ModuleData {
  std::string name;
  /// "module", or a matched receiver (channel/ideal_receiver.hpp) of which only front end and
  /// directivity of the rest count: "coherent", "noncoherent".
  std::string detector = "module";
  double detector_threshold = 0;  // of a matched receiver: share of the lit amplitude; 0: optimum
  // Band-pass.
  double centre_hz = 56e3;
  double centre_tolerance = 0.05;  // of a unit's centre, as a share of it
  double q = 10;
  // Sensitivity. Emin: peak irradiance of a 30-cycle burst at f0 at which the output pulse is
  // emin_width_cycles longer than the burst (a negative number: shorter).
  double emin_mw_per_m2 = 0.12;
  double emin_width_cycles = -5;
  double emin_max_mw_per_m2 = 0;  // of the least sensitive unit; 0: the sheet does not say
  double emax_w_per_m2 = 50;
  double supply_min_v = 0, supply_max_v = 0;  // 0: the sheet does not say
  // Demodulator.
  double comparator_hold_cycles = 1.25;
  double integrator_cycles = 8;
  double atc_fraction = 0.4;
  double atc_release_ms = 10;
  // Slow AGC; attack 0 means that the part has none.
  double agc_attack_db_per_ms = 0.3;
  double agc_max_duty = 0.305;
  double agc_long_burst_cycles = 80;
  double agc_long_burst_ms = 0;  // where the sheet has the limit in ms; else 0
  double agc_free_cycles = 0;
  double agc_min_gap_cycles = 29;
  double agc_hold_ms = 0;
  double agc_pinned_cycles = 0;  // longest burst that a figure shows; 0: the rule has no end
  double agc_margin_db = 3;
  double agc_range_db = 120;
  // Front end and noise.
  double aperture_mm2 = 6.7;
  double responsivity_a_per_w = 0.65;
  double feedback_ohm = 1e6;
  double temperature_k = 298.15;  // of the surroundings (channel/conditions)
  double front_end_hz = 150e3;
  // Threshold in ambient light: Emin^2 grows by k*E*(1 + E/Es), E in W/m2, Emin in mW/m2.
  double ambient_k = 0.047;
  double ambient_es_w_per_m2 = 18;
  // Response off axis, as relative distance against degrees; empty: cos^1. Vertical: from -90 below
  // to 90 above the axis; empty: as in the plane of the floor.
  Curve directivity, directivity_vertical;
  // Response against the wavelength in nm, in any unit; empty: the same at all.
  Curve spectral;
  // Emin in mW/m2 against degrees Celsius, supply in V and its ripple in mV rms, at f0 and at two
  // other frequencies; empty: the sheet does not say.
  Curve emin_against_temperature, emin_against_supply;
  Curve emin_against_ripple, emin_against_ripple_10_khz, emin_against_ripple_100_khz;
  AllBounds bounds;  // of the numbers that no sheet prints
};

/// Wavelength at which Emin is taken: of the emitters that sheets measure with.
constexpr double emin_nm = 940;

inline bool is_matched(const ModuleData& data) { return data.detector != "module"; }

/// Units inside: irradiance in mW/m2 as the peak of an on/off waveform of 50 % duty at the input,
/// amplitude in mW/m2 behind the band-pass; times in samples. Of one unit (T = float), or of many
/// that need not be alike.
template <class T>
struct ModuleDesignOf {
  T front_end;  // share of the way to its input that the front end goes in a sample
  BandPassDesignOf<T> band_pass;
  T limit;      // irradiance at which the input clips
  T threshold;  // amplitude of the fixed comparator, slow AGC at rest
  T atc_fraction, atc_decay;
  DemodulatorDesignOf<T> demodulator;
  SlowAgcDesignOf<T> agc;
};
using ModuleDesign = ModuleDesignOf<float>;

template <class T>
void set_lane(ModuleDesignOf<T>& all, int lane, const ModuleDesign& one) {
  dsp::set_lane(all.front_end, lane, one.front_end);
  set_lane(all.band_pass, lane, one.band_pass);
  dsp::set_lane(all.limit, lane, one.limit);
  dsp::set_lane(all.threshold, lane, one.threshold);
  dsp::set_lane(all.atc_fraction, lane, one.atc_fraction);
  dsp::set_lane(all.atc_decay, lane, one.atc_decay);
  set_lane(all.demodulator, lane, one.demodulator);
  set_lane(all.agc, lane, one.agc);
}

/// The same unit in every lane.
template <class T>
ModuleDesignOf<T> in_all_lanes(const ModuleDesign& one) {
  ModuleDesignOf<T> all;
  for (int i = 0; i < dsp::lanes<T>; ++i) set_lane(all, i, one);
  return all;
}

/// Emin in ambient light: sqrt(Emin^2 + k E (1 + E / Es)), mW/m2. Vishay 82459 Fig. 6 within 6 %
/// rms.
double emin_in_ambient(const ModuleData& data, dsp::WattsPerSquareMetre ambient);

/// Amplitude behind the band-pass at which the comparator fires, slow AGC at rest, mW/m2.
double comparator_level(const ModuleData& data, dsp::WattsPerSquareMetre ambient);

/// The slow AGC at so many samples a second.
SlowAgcDesign design_slow_agc(const ModuleData& data, dsp::Hertz sample_rate);

ModuleDesign design_module(const ModuleData& data, dsp::WattsPerSquareMetre ambient,
                           dsp::Hertz sample_rate);

/// Constant part of the delay from light to pin: hold and integrator.
dsp::Seconds nominal_delay(const ModuleData& data);

/// What the module has inside at one sample, for whoever wants to look.
template <class T>
struct ModuleTaps {
  T band_pass, threshold, integrator, agc_gain;
  T peak;  // of the band-pass's output in the sample
};

template <class T>
class ReceiverModule {
 public:
  explicit ReceiverModule(const ModuleDesignOf<T>& d)
      : front_end_(d.front_end),
        limit_(d.limit),
        threshold_(d.threshold),
        margin_(d.agc.margin),
        part_(d.demodulator.part),
        ticks_(d.agc.samples_per_tick),
        to_tick_(ticks_),
        band_pass_(d.band_pass),
        follower_(d.atc_fraction, d.atc_decay),
        signal_(d.demodulator),
        activity_(d.demodulator),
        integrator_(d.demodulator),
        agc_(d.agc) {
    set_gain(T(1.0f));
  }

  /// One sample, in two steps: irradiance to the largest output of the band-pass in the sample, and
  /// that to the pin's level: false (low) while light is reported. The first needs nothing that the
  /// second gives, so a block of samples is two loops, which need not wait for each other.
  T filtered(T irradiance) {
    light_ = dsp::fused(front_end_, irradiance - light_, light_);
    band_pass_(dsp::smaller(dsp::larger(light_, -limit_), limit_));
    return band_pass_.peak();
  }
  dsp::Mask<T> demodulated(T peak) {
    const T following = follower_(peak);
    level_ = dsp::larger(fixed_, following);
    active_ = active_ + activity_(peak > dsp::larger(sensed_, following));
    if (--to_tick_ == 0) tick();
    return !integrator_(signal_(peak > level_));
  }

  ModuleTaps<T> taps() const {
    return {band_pass_.output(), level_, dsp::to_float(integrator_.level()) * part_, gain_,
            band_pass_.peak()};
  }

 private:
  void tick() {
    to_tick_ = ticks_;
    set_gain(agc_(dsp::to_float(active_) * part_));
    active_ = dsp::Words<T>(0u);
  }

  void set_gain(T gain) {
    gain_ = gain;
    fixed_ = threshold_ * gain;
    sensed_ = fixed_ * margin_;
  }

  T front_end_, limit_, threshold_, margin_, part_;
  T light_ = T(0.0f);                         // what the front end makes of the irradiance
  T gain_, fixed_;                            // of the slow AGC; the threshold with it
  T sensed_;                                  // where activity begins
  T level_ = T(0.0f);                         // of the comparator
  dsp::Words<T> active_ = dsp::Words<T>(0u);  // activity since the last tick, in parts of a sample
  int ticks_, to_tick_;
  BandPass<T> band_pass_;
  PeakFollower<T> follower_;
  PulseHold<T> signal_, activity_;
  PulseIntegrator<T> integrator_;
  SlowAgc<T> agc_;
};

}  // namespace channel
