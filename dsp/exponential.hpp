#pragma once
// Powers of two, for one trial or many.
#include "dsp/lanes.hpp"

namespace dsp {

/// 2^x for |x| < 126; relative error below 3e-7. The Taylor series of 2^r around the nearest whole
/// number (ln(2)^k / k!), whose power is added to the exponent.
template <class T>
T power_of_two(T x) {
  constexpr float to_whole = 12582912.0f;  // 1.5 * 2^23: what is added to it is rounded to a whole
  const T shifted = x + T(to_whole);
  const T r = x - (shifted - T(to_whole));
  T p = fused(T(1.5403530393381610e-4f), r, T(1.3333558146428443e-3f));
  p = fused(p, r, T(9.6181291076284772e-3f));
  p = fused(p, r, T(0.055504108664821580f));
  p = fused(p, r, T(0.24022650695910071f));
  p = fused(p, r, T(0.69314718055994531f));
  p = fused(p, r, T(1.0f));
  return from_bits(to_bits(p) + (to_bits(shifted) << 23));
}

}  // namespace dsp
