#pragma once
// Angles in turns, for one lane or eight.
#include "dsp/lanes.hpp"

namespace dsp {

/// Angle of (re, im) in turns, -0.5 to 0.5; absolute error below 3e-6.
template <class T>
T turns(T re, T im) {
  const T zero(0.0f);
  const T a = larger(re, -re), b = larger(im, -im);
  const T t = smaller(a, b) / (larger(a, b) + T(1e-30f));
  const T y = t * t;
  T p = fused(T(0.0033314013f), y, T(-0.0135931545f));
  p = fused(p, y, T(0.0287135705f));
  p = fused(p, y, T(-0.0525856803f));
  p = fused(p, y, T(0.1591356445f));
  p = p * t;
  p = choose(b > a, T(0.25f) - p, p);
  p = choose(re < zero, T(0.5f) - p, p);
  return choose(im < zero, -p, p);
}

/// acos(x) in turns, x in [0, 1]; absolute error below 1.1e-5 (Abramowitz & Stegun 4.4.45).
template <class T>
T turns_of_cosine(T x) {
  T p = fused(T(-2.980861e-3f), x, T(1.181900e-2f));
  p = fused(p, x, T(-3.375905e-2f));
  p = fused(p, x, T(0.24998925f));
  return square_root(larger(T(1.0f) - x, T(0.0f))) * p;
}

}  // namespace dsp
