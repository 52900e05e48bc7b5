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

constexpr dsp::WattsPerSquareMetre daylight(double lux) {
  return dsp::WattsPerSquareMetre(lux * 10 / 8200);
}

}  // namespace channel
