#pragma once
// Strong types for quantities that cross a C++ border, so that metres cannot be passed for hertz.
// One double each, zero cost; inside a stage, after its constructor, plain floats take over.
#include <compare>
#include <numbers>

namespace dsp {

template <class Tag>
struct Quantity {
  double value = 0.0;

  constexpr Quantity() = default;
  constexpr explicit Quantity(double v) : value(v) {}
  constexpr auto operator<=>(const Quantity&) const = default;

  constexpr Quantity& operator+=(Quantity o) { return value += o.value, *this; }
  constexpr Quantity& operator-=(Quantity o) { return value -= o.value, *this; }
  friend constexpr Quantity operator+(Quantity a, Quantity b) { return a += b; }
  friend constexpr Quantity operator-(Quantity a, Quantity b) { return a -= b; }
  friend constexpr Quantity operator-(Quantity a) { return Quantity(-a.value); }
  friend constexpr Quantity operator*(Quantity a, double k) { return Quantity(a.value * k); }
  friend constexpr Quantity operator*(double k, Quantity a) { return a * k; }
  friend constexpr Quantity operator/(Quantity a, double k) { return Quantity(a.value / k); }
  friend constexpr double operator/(Quantity a, Quantity b) { return a.value / b.value; }
};

using Seconds = Quantity<struct SecondsTag>;
using Hertz = Quantity<struct HertzTag>;
using Metres = Quantity<struct MetresTag>;
using Radians = Quantity<struct RadiansTag>;
using Amperes = Quantity<struct AmperesTag>;
/// Irradiance, W/m2 (data sheets print mW/m2; texts and files say which).
using WattsPerSquareMetre = Quantity<struct WattsPerSquareMetreTag>;
/// Radiant intensity, W/sr.
using WattsPerSteradian = Quantity<struct WattsPerSteradianTag>;

constexpr Seconds period(Hertz f) { return Seconds(1.0 / f.value); }
constexpr double cycles(Seconds t, Hertz f) { return t.value * f.value; }
constexpr Radians degrees(double d) { return Radians(d * std::numbers::pi / 180.0); }
constexpr double in_degrees(Radians angle) { return angle.value * 180 / std::numbers::pi; }

}  // namespace dsp
