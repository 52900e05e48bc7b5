#pragma once
// The photodiode that tests look at.
#include "channel/photodiode.hpp"

namespace channel {

// Vishay 81521 rev 2.1: 50 uA at 1 mW/cm2 and 950 nm on 7.5 mm2; 2 nA in the dark.
inline const PhotodiodeData bpw34{.name = "BPW34",
                                  .area_mm2 = 7.5,
                                  .responsivity_a_per_w = 0.6667,
                                  .dark_current_na = 2,
                                  .capacitance_pf = 25,
                                  .half_angle_deg = 65};

}  // namespace channel
