#pragma once
// What a receiver module's surroundings make of it: temperature, supply voltage and its ripple,
// the colour of the light; and what manufacture makes of a single unit.
#include "channel/receiver_module.hpp"

namespace channel {

/// Data sheets state typical values at these.
struct Conditions {
  double celsius = 25;
  double supply_v = 5;
  double ripple_mv_rms = 0;  // on the supply, at the module's own f0: the worst frequency
};

/// The part as it is under these conditions: Emin moves as its curves say. Temperature and voltage
/// are factors relative to the curve at 25 degrees C and 5 V, the ripple adds as a disturbance
/// does, in squares. Outside a curve its end holds. Thermal noise has the temperature too.
ModuleData under(const Conditions& conditions, ModuleData part);

/// Response at a wavelength relative to that at 940 nm, at which Emin is taken; 1 without a curve.
double spectral_response(const ModuleData& part, double wavelength_nm);

/// One unit of the population, for two random numbers in [0, 1): f0 uniform within its tolerance,
/// Emin between typical and maximum, uniform in dB. A part without a maximum has one Emin.
ModuleData unit_of(ModuleData part, double centre_draw, double emin_draw);

}  // namespace channel
