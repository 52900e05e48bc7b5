#pragma once
// Noise of a receiver's front end: shot noise of all light on the photodiode and thermal noise of
// the feedback resistor. Densities are one-sided, A^2/Hz: i_n^2 = 2 q I + 4 k T / Rf.
#include "channel/receiver_module.hpp"
#include "dsp/units.hpp"

namespace channel {

/// Photocurrent of an irradiance: responsivity times effective aperture times irradiance.
dsp::Amperes photocurrent(const ModuleData& data, dsp::WattsPerSquareMetre irradiance);

/// Mean irradiance whose shot noise counts while the carrier is on: all of it; for a matched
/// receiver the ambient light alone, since the closed forms want noise that does not depend on the
/// bit.
dsp::WattsPerSquareMetre noisy_light(const ModuleData& data, dsp::WattsPerSquareMetre ambient,
                                     dsp::WattsPerSquareMetre signal);

/// One-sided density of a current's shot noise, 2 q I, A^2/Hz.
double shot_noise_density(dsp::Amperes mean);

/// One-sided density of a resistor's noise current, 4 k T / R, A^2/Hz.
double thermal_noise_density(double kelvin, double ohm);

/// One-sided density of the noise current at a mean photocurrent, A^2/Hz.
double noise_density(const ModuleData& data, dsp::Amperes mean);

/// Noise bandwidth of the band-pass: (pi / 2) f0 / Q, Hz.
dsp::Hertz noise_bandwidth(const ModuleData& data);

/// Standard deviation, as irradiance in mW/m2, of white samples of that density at a sample rate.
double sample_deviation_mw_per_m2(const ModuleData& data, double density, dsp::Hertz sample_rate);

}  // namespace channel
