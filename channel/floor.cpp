#include "channel/floor.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace channel {
namespace {

double squared(double a) { return a * a; }

// Fresnel's equations; the cosine of the angle of incidence is the sine of the grazing angle.
double fresnel(double n, double sin_grazing) {
  assert(n >= 1 && sin_grazing >= 0);
  if (n == 1) return 0;  // no surface; the formula would be 0/0 along the floor
  const double inside = std::sqrt(n * n - 1 + squared(sin_grazing));  // n times the inner cosine
  const double rs = squared((sin_grazing - inside) / (sin_grazing + inside));
  const double rp = squared((n * n * sin_grazing - inside) / (n * n * sin_grazing + inside));
  return (rs + rp) / 2;
}

double ament(double roughness_um, double sin_grazing, dsp::Metres wavelength) {
  const double phase = 4 * std::numbers::pi * roughness_um * 1e-6 * sin_grazing / wavelength.value;
  return std::exp(-squared(phase));
}

}  // namespace

double fresnel_reflectance(double refractive_index, dsp::Radians grazing) {
  return fresnel(refractive_index, std::sin(grazing.value));
}

double roughness_factor(double roughness_um, dsp::Radians grazing, dsp::Metres wavelength) {
  return ament(roughness_um, std::sin(grazing.value), wavelength);
}

double mirrored_share(const Floor& floor, double sin_grazing, dsp::Metres wavelength) {
  const double surface = fresnel(floor.refractive_index, sin_grazing);
  const double both = surface + (1 - surface) * floor.metal_reflectance;
  return both * ament(floor.roughness_um, sin_grazing, wavelength);
}

double diffuse_brdf(const Floor& floor, double sin_in, double sin_out, dsp::Metres wavelength) {
  return floor.diffuse_reflectance / std::numbers::pi *
         (1 - mirrored_share(floor, sin_in, wavelength)) *
         (1 - mirrored_share(floor, sin_out, wavelength));
}

}  // namespace channel
