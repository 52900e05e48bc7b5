#pragma once
// Photodiode: a bare diode by its data sheet, for scenarios that look at the light itself and not
// at a receiver module's output. Noise is shot noise: what the amplifier adds is not its business.
#include <string>

#include "channel/number_bounds.hpp"
#include "dsp/units.hpp"

namespace channel {

struct PhotodiodeData {
  std::string name;
  double area_mm2 = 7.5;  // radiant sensitive area
  double responsivity_a_per_w = 0.65;
  double dark_current_na = 2;  // reverse biased, at 25 C
  double capacitance_pf = 25;  // at the bias of the dark current or near it
  double half_angle_deg = 65;  // to half sensitivity
  AllBounds bounds = {};       // of the numbers that no document prints
};

/// Photocurrent of an irradiance on axis: responsivity times area times irradiance.
dsp::Amperes photocurrent(const PhotodiodeData& data, dsp::WattsPerSquareMetre irradiance);

/// Sensitivity at `off_axis` (0..pi) relative to the axis: cos^n that is 1/2 at the half angle; 0
/// behind the diode.
double relative_sensitivity(const PhotodiodeData& data, dsp::Radians off_axis);

/// One-sided density of the shot noise of a photocurrent and the dark current: 2 q I, A^2/Hz.
double shot_noise_density(const PhotodiodeData& data, dsp::Amperes photocurrent);

/// Power on the diode in the dark whose current equals the rms noise in 1 Hz: NEP, W/sqrt(Hz).
double noise_equivalent_power(const PhotodiodeData& data);

}  // namespace channel
