#pragma once
// Steady light as lamps and days are rated, in lux, made into the irradiance that matters to a
// module: 10 W/m2 as if at 950 nm is 1.4 klx of standard illuminant A (tungsten, 2855 K) or 8.2 klx
// of daylight (5900 K) (Vishay 82459 rev 1.8 Fig. 6). Another ratio than Fig. 6's holds for a part
// with another optical filter.
#include "dsp/units.hpp"

namespace channel {

constexpr dsp::WattsPerSquareMetre tungsten_light(double lux) {
  return dsp::WattsPerSquareMetre(lux * 10 / 1400);
}

/// Of a halogen lamp, 3000 K: Planck's law gives 0.84 of what 2856 K has a lux, by a response of 1
/// at 950 nm and a half at 870 and 1030 nm.
constexpr dsp::WattsPerSquareMetre halogen_light(double lux) { return 0.84 * tungsten_light(lux); }

/// Of fluorescent lamps: the measured spectrum of an Osram L 18W/840 at 25 degrees C (Aphalo,
/// photobiologyLamps) by the same response; other lamps 5e-6 to 1e-4, and this one 2.7e-4 at 5
/// degrees C, when argon's lines are strong.
constexpr dsp::WattsPerSquareMetre fluorescent_light(double lux) {
  return dsp::WattsPerSquareMetre(lux * 2e-5);
}

/// Of white LEDs, whose phosphor hardly shines there: some 25 measured spectra (photobiologyLamps)
/// have 1e-7 to 5e-6 a lux, near to what the instruments see.
constexpr dsp::WattsPerSquareMetre white_led_light(double lux) {
  return dsp::WattsPerSquareMetre(lux * 1e-6);
}

/// Fig. 6's 1.2 W/m2 of 1000 lx; the spectrum of ASTM G173 has 0.95 to 1.0.
constexpr dsp::WattsPerSquareMetre daylight(double lux) {
  return dsp::WattsPerSquareMetre(lux * 10 / 8200);
}

}  // namespace channel
