#pragma once
// Emitter: an infrared LED by its data sheet: radiant intensity on axis from drive current, and the
// pattern off axis. Specified by intensity, never by total flux: a cos^m beam of the same half
// angle has a third less flux than the real part, whose side skirt it misses (Vishay 81010 Fig. 9).
#include <string>

#include "channel/curve.hpp"
#include "dsp/units.hpp"

namespace channel {

struct EmitterData {
  std::string name;
  Curve intensity_mw_per_sr;   // on axis, against drive current in mA; log-log between points
  Curve pattern;               // relative intensity against angle off axis in degrees, 0..90
  double wavelength_nm = 940;  // of the peak (Vishay 81010 rev 2.4, basic characteristics)
};

/// Radiant intensity on axis at a drive current in amperes (peak of the on/off waveform).
/// Log-log interpolation; below the first point proportional to the current, above the last one
/// constant (the sheet ends there). The tabulated values must be positive.
dsp::WattsPerSteradian axial_intensity(const EmitterData& emitter, dsp::Amperes current);

/// Intensity at `off_axis` (0..pi) relative to the axis; 0 behind the LED (beyond 90 degrees).
double relative_intensity(const EmitterData& emitter, dsp::Radians off_axis);

}  // namespace channel
