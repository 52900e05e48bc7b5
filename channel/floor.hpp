#pragma once
// Floor: a plane at z = 0 that mirrors (Fresnel, weakened by roughness) and scatters (Lambert).
// At 10 mm height and grazing incidence even plain varnish is a near-perfect mirror.
// Energy: the mirror takes the share S of the light; the rest 1 - S, which includes what roughness
// took out of the image, enters the scattering layer, which gives back rho of it at most.
// A bump is a straight ridge across the line between the two feet, thin and endless: a knife edge,
// for the first Fresnel zone is 0.5 mm wide at 1 m. It scatters no light of its own.
#include <string>

#include "channel/number_bounds.hpp"
#include "dsp/units.hpp"

namespace channel {

struct Floor {
  double refractive_index = 1.5;     // of the surface layer; 1: no mirror image
  double roughness_um = 0.0;         // rms height; weakens the mirror image
  double diffuse_reflectance = 0.0;  // Lambertian rho, 0..1, of the layer under the surface
  double metal_reflectance = 0.0;    // share that metal mirrors of what the surface lets in
  double bump_height_mm = 0.0;       // 0: an even floor
  double bump_position = 0.5;        // of the way from the LED's foot to the receiver's, 0..1
  std::string name = {};             // of the part
  AllBounds bounds = {};             // of the numbers that no document prints
};

/// Unpolarised Fresnel reflectance (Rs + Rp) / 2 at grazing angle `grazing` (0 = along the floor).
double fresnel_reflectance(double refractive_index, dsp::Radians grazing);

/// Specular power that roughness leaves: exp(-(4 pi sigma sin(grazing) / lambda)^2) (Ament).
double roughness_factor(double roughness_um, dsp::Radians grazing, dsp::Metres wavelength);

/// S, the share of light that the floor mirrors at the grazing angle with this sine: by Fresnel at
/// the surface, by metal of what that lets in, both weakened by Ament's factor. From 0 to 1.
double mirrored_share(const Floor& floor, double sin_grazing, dsp::Metres wavelength);

/// BRDF of the scattered light, 1/sr: rho / pi (1 - S_in) (1 - S_out), for the sines of the grazing
/// angles in and out. What is mirrored on the way in does not reach the layer, what is mirrored on
/// the way out stays in it: reciprocal, and with S never more than the light that came.
double diffuse_brdf(const Floor& floor, double sin_in, double sin_out, dsp::Metres wavelength);

}  // namespace channel
