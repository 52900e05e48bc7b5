#include "channel/conditions.hpp"

#include <algorithm>
#include <cmath>

namespace channel {
namespace {

constexpr double kelvin_at_zero_celsius = 273.15;

/// A curve's value relative to that at a reference; 1 without a curve.
double relative(const Curve& curve, double at, double reference) {
  return curve.empty() ? 1 : curve(at) / curve(reference);
}

double supply_factor(const ModuleData& part, double supply_v) {
  constexpr double plotted_v = 5;  // at which Fig. 12 meets the typical Emin
  return std::isnan(supply_v) ? 1 : relative(part.emin_against_supply, supply_v, plotted_v);
}

/// Rise of Emin, in squares, that ripple makes.
double ripple_squared(const Curve& curve, double mv_rms) {
  if (curve.empty()) return 0;
  const double rest = curve.y.front(), now = curve(mv_rms);
  return now * now - rest * rest;
}

constexpr RippleFrequency frequencies[] = {{"f0", &ModuleData::emin_against_ripple},
                                           {"10 kHz", &ModuleData::emin_against_ripple_10_khz},
                                           {"100 kHz", &ModuleData::emin_against_ripple_100_khz}};

}  // namespace

std::span<const RippleFrequency> ripple_frequencies() { return frequencies; }

const RippleFrequency& ripple_frequency(std::string_view name) {
  return *std::ranges::find(frequencies, name, &RippleFrequency::name);
}

ModuleData under(const Conditions& c, ModuleData part) {
  const double typical = part.emin_mw_per_m2;
  const double still = typical * supply_factor(part, c.supply_v) *
                       relative(part.emin_against_temperature, c.celsius, Conditions{}.celsius);
  const double ripple = ripple_squared(part.*c.ripple_at.emin, c.ripple_mv_rms);
  part.emin_mw_per_m2 = std::sqrt(still * still + ripple);
  const double rise = part.emin_mw_per_m2 / typical;
  part.emin_max_mw_per_m2 *= rise;
  for (NumberBounds& bounds : part.bounds)
    if (bounds.number == "emin_mw_per_m2" || bounds.number == "emin_max_mw_per_m2")
      bounds = {bounds.number, bounds.low * rise, bounds.high * rise, bounds.distribution};
  part.temperature_k = c.celsius + kelvin_at_zero_celsius;
  return part;
}

double spectral_response(const ModuleData& part, double wavelength_nm) {
  return relative(part.spectral, wavelength_nm, emin_nm);
}

ModuleData unit_of(ModuleData part, double centre_draw, double emin_draw) {
  part.centre_hz *= 1 + part.centre_tolerance * (2 * centre_draw - 1);
  const double most = part.emin_max_mw_per_m2 / part.emin_mw_per_m2;
  if (most > 1) part.emin_mw_per_m2 *= std::pow(most, emin_draw);
  return part;
}

}  // namespace channel
