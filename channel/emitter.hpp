#pragma once
// Emitter: an infrared LED by its data sheet: radiant intensity on axis from drive current and
// temperature, the pattern off axis, and the wavelength. Specified by intensity, never by total
// flux: a cos^m beam of the same half angle has a third less flux than the real part, whose side
// skirt it misses (Vishay 81010 Fig. 9).
#include <string>

#include "channel/curve.hpp"
#include "channel/number_bounds.hpp"
#include "dsp/units.hpp"

namespace channel {

struct EmitterData {
  std::string name;
  Curve intensity_mw_per_sr;   // on axis, against drive current in mA; log-log between points
  Curve pattern;               // relative intensity against angle off axis in degrees, 0..90
  double half_angle_deg = 0;   // to half intensity; used where there is no pattern
  double wavelength_nm = 940;  // of the peak at 25 C (Vishay 81010 rev 2.4, basic characteristics)
  double wavelength_nm_per_k = 0.2;  // the same table
  double continuous_ma = 100;        // most that it bears for as long as a bit, as a mean
  // Intensity against degrees Celsius, in any unit; empty: the sheet does not say.
  Curve relative_intensity_against_temperature = {};
  AllBounds bounds = {};  // of the numbers that no document prints
};

/// Temperature in degrees Celsius at which data sheets state an LED.
constexpr double emitter_reference_celsius = 25;

/// Radiant intensity on axis at a drive current in amperes (peak of the on/off waveform).
/// Log-log interpolation; below the first point proportional to the current, above the last one
/// constant (the sheet ends there). The tabulated values must be positive. At another temperature
/// than 25 C times the temperature curve over its value at 25 C; without a curve the same as there.
dsp::WattsPerSteradian axial_intensity(const EmitterData& emitter, dsp::Amperes current,
                                       double celsius = emitter_reference_celsius);

/// Wavelength of the peak at a temperature.
dsp::Metres wavelength(const EmitterData& emitter, double celsius = emitter_reference_celsius);

/// m of the beam cos^m that has half its intensity at `half_angle`: ln(1/2) / ln(cos half_angle).
double cosine_power(dsp::Radians half_angle);

/// Intensity at `off_axis` (0..pi) relative to the axis; 0 behind the LED (beyond 90 degrees). The
/// pattern's curve, or where that is empty cos^m.
double relative_intensity(const EmitterData& emitter, dsp::Radians off_axis);

}  // namespace channel
