// What the files of LEDs, floors and photodiodes may say; modules: sim/scenario/part_keys.cpp.
#include <utility>

#include "sim/scenario/figures.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {
namespace {

using Emitter = channel::EmitterData;
using Photodiode = channel::PhotodiodeData;

template <class Part>
PartNumber<Part> optional_number(double Part::*member, KeyFacts facts) {
  return {std::move(facts), member, false};
}

template <class Part>
PartNumber<Part> required_number(double Part::*member, KeyFacts facts) {
  return {std::move(facts), member, true};
}

std::vector<PartNumber<Emitter>> led_numbers() {
  return {
      optional_number(&Emitter::half_angle_deg,
                      {"half_angle_deg", "degree", from(1, 85), "angle to half intensity",
                       "instead of `pattern`: a beam cos^m, which has no side skirt"}),
      optional_number(&Emitter::wavelength_nm,
                      {"wavelength_nm", "nm", from(300, 2000), "wavelength of the peak", ""}),
      optional_number(&Emitter::wavelength_nm_per_k,
                      {"wavelength_nm_per_k", "nm/K", from(-2, 2), "growth of the wavelength", ""}),
      optional_number(&Emitter::continuous_ma,
                      {"continuous_ma", "mA", from(0.1, 1e5), "largest continuous current",
                       "bits are long: the mean over a carrier period counts"}),
  };
}

std::vector<PartCurve<Emitter>> led_curves() {
  return {{"intensity",
           "radiant intensity on axis against the current",
           {"ma", "mA", from(1e-3, 1e5), "current", ""},
           {"mw_per_sr", "mW/sr", from(1e-3, 1e6), "radiant intensity", ""},
           &Emitter::intensity_mw_per_sr,
           true},
          {"pattern",
           "relative intensity against the angle off axis",
           {"degrees", "degree", from(0, 90), "angle off axis", ""},
           {"relative_intensity", "1", from(0, 1.5), "relative intensity", ""},
           &Emitter::pattern,
           false},
          {"relative_intensity_against_temperature",
           "intensity against the temperature; without it the LED has 25 degrees C",
           {"celsius", "degree_C", from(-60, 150), "temperature", ""},
           {"relative", "1", from(1e-3, 100), "relative intensity", ""},
           &Emitter::relative_intensity_against_temperature,
           false}};
}

std::vector<PartNumber<channel::Floor>> floor_numbers() {
  using F = channel::Floor;
  return {
      required_number(&F::refractive_index,
                      {"refractive_index", "1", from(1, 4), "refractive index of the surface",
                       "1: it mirrors nothing; varnish, vinyl: 1.5"}),
      required_number(&F::roughness_um, {"roughness_um", "um", from(0, 1e4),
                                         "rms roughness of the floor", "weakens the mirror image"}),
      required_number(&F::diffuse_reflectance, {"diffuse_reflectance", "1", from(0, 1),
                                                "diffuse reflectance of the floor", ""}),
      optional_number(&F::metal_reflectance,
                      {"metal_reflectance", "1", from(0, 1),
                       "share that metal mirrors of what the surface lets in",
                       "0: no metal; 1: a perfect mirror"}),
  };
}

std::vector<PartNumber<Photodiode>> photodiode_numbers() {
  return {
      required_number(&Photodiode::area_mm2,
                      {"area_mm2", "mm2", from(1e-3, 1e4), "radiant sensitive area", ""}),
      required_number(&Photodiode::responsivity_a_per_w,
                      {"responsivity_a_per_w", "A/W", from(0.01, 1), "responsivity at 940 nm", ""}),
      required_number(&Photodiode::dark_current_na,
                      {"dark_current_na", "nA", from(0, 1e6), "dark current", "reverse biased"}),
      required_number(&Photodiode::capacitance_pf,
                      {"capacitance_pf", "pF", from(0, 1e5), "capacitance", "at the bias in use"}),
      required_number(&Photodiode::half_angle_deg,
                      {"half_angle_deg", "degree", from(1, 85), "angle to half sensitivity", ""}),
  };
}

}  // namespace

const PartKeys<channel::EmitterData>& led_keys() {
  static const PartKeys<Emitter> keys{"LED",
                                      "leds",
                                      led_numbers(),
                                      led_curves(),
                                      {{"pattern", "half_angle_deg"}},
                                      figure_names(led_figures())};
  return keys;
}

const PartKeys<channel::Floor>& floor_keys() {
  static const PartKeys<channel::Floor> keys{"floor", "floors", floor_numbers(), {}};
  return keys;
}

const PartKeys<channel::PhotodiodeData>& photodiode_keys() {
  static const PartKeys<Photodiode> keys{"photodiode", "photodiodes", photodiode_numbers(), {}};
  return keys;
}

}  // namespace sim
