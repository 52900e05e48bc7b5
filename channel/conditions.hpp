#pragma once
// What a receiver module's surroundings make of it: temperature, supply voltage and its ripple,
// the colour of the light; and what manufacture makes of a single unit.
#include <limits>
#include <span>
#include <string_view>

#include "channel/receiver_module.hpp"

namespace channel {

/// A frequency of the supply's ripple for which data sheets plot Emin (Vishay 82459 Fig. 7).
struct RippleFrequency {
  std::string_view name;  // "10 kHz"
  Curve ModuleData::*emin;
};

/// The first is the module's own f0, the worst.
std::span<const RippleFrequency> ripple_frequencies();
/// The one of that name, which must be one of them.
const RippleFrequency& ripple_frequency(std::string_view name);

/// Data sheets state typical values at these.
struct Conditions {
  double celsius = 25;
  double supply_v = std::numeric_limits<double>::quiet_NaN();  // NaN: as the sheet's typical values
  double ripple_mv_rms = 0;                                    // on the supply
  RippleFrequency ripple_at = ripple_frequencies().front();
};

/// The part as it is under these conditions: Emin moves as its curves say, typical and maximum
/// alike. Temperature and voltage are factors relative to the curve at 25 degrees C and 5 V, the
/// ripple adds as a disturbance does, in squares. Outside a curve its end holds. Thermal noise has
/// the temperature too.
ModuleData under(const Conditions& conditions, ModuleData part);

/// Response at a wavelength relative to that at 940 nm, at which Emin is taken; 1 without a curve.
double spectral_response(const ModuleData& part, double wavelength_nm);

/// One unit of the population, for two random numbers in [0, 1): f0 uniform within its tolerance,
/// Emin between typical and maximum, uniform in dB. A part without a maximum has one Emin.
ModuleData unit_of(ModuleData part, double centre_draw, double emin_draw);

}  // namespace channel
