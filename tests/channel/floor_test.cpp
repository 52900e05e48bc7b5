#include "channel/floor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace channel {
namespace {

using std::numbers::pi;

constexpr dsp::Metres infrared(940e-9);

// The grazing angle of the mirror image at 10 mm height.
dsp::Radians grazing_at(double distance_m) { return dsp::Radians(std::atan(0.02 / distance_m)); }

TEST(Fresnel, MeetsTheEquationsAtTenMillimetres) {
  // Fresnel's equations worked out apart from this program, to three digits.
  struct Row {
    double distance_m, r145, r150, r160;
  };
  constexpr Row table[] = {{.05, .140, .150, .167}, {.1, .336, .346, .361}, {.2, .566, .573, .583},
                           {.3, .681, .686, .693},  {.5, .792, .796, .800}, {1, .889, .891, .893},
                           {2, .943, .944, .945},   {3, .961, .962, .963},  {5, .977, .977, .978}};
  for (const Row& row : table) {
    const dsp::Radians grazing = grazing_at(row.distance_m);
    EXPECT_NEAR(fresnel_reflectance(1.45, grazing), row.r145, 6e-4) << row.distance_m;
    EXPECT_NEAR(fresnel_reflectance(1.5, grazing), row.r150, 6e-4) << row.distance_m;
    EXPECT_NEAR(fresnel_reflectance(1.6, grazing), row.r160, 6e-4) << row.distance_m;
  }
}

TEST(Fresnel, NormalIncidence) {
  for (double n : {1.1, 1.33, 1.5, 2.4}) {
    EXPECT_NEAR(fresnel_reflectance(n, dsp::Radians(pi / 2)), std::pow((n - 1) / (n + 1), 2),
                1e-12);
  }
}

TEST(Fresnel, BrewstersAngleLeavesHalfOfRs) {  // tan(incidence) = n: Rp = 0
  const double n = 1.5;
  const double rs = std::pow((n * n - 1) / (n * n + 1), 2);
  EXPECT_NEAR(fresnel_reflectance(n, dsp::Radians(std::atan(1 / n))), rs / 2, 1e-12);
}

TEST(Fresnel, SmallAngles) {  // Rs = 1 - 4 g / sqrt(n^2-1), Rp = 1 - 4 n^2 g / sqrt(n^2-1)
  const double n = 1.5, g = 1e-5;
  const double loss = 2 * g * (1 + n * n) / std::sqrt(n * n - 1);
  EXPECT_NEAR(1 - fresnel_reflectance(n, dsp::Radians(g)), loss, 1e-3 * loss);
}

TEST(Fresnel, IsAPerfectMirrorAlongTheFloorAndNoneWithoutASurface) {
  EXPECT_DOUBLE_EQ(fresnel_reflectance(1.5, dsp::Radians(0)), 1);
  for (double g : {0.0, 1e-12, 0.1, 1.5}) EXPECT_EQ(fresnel_reflectance(1, dsp::Radians(g)), 0);
}

TEST(Ament, RoughnessAtOneMetre) {  // worked out for 940 nm at 10 mm height
  EXPECT_NEAR(roughness_factor(2, grazing_at(1), infrared), .75, .005);
  EXPECT_NEAR(roughness_factor(5, grazing_at(1), infrared), .17, .005);
}

TEST(Ament, SmoothFloorsAndGrazingLightLoseNothing) {
  EXPECT_EQ(roughness_factor(0, dsp::Radians(1), infrared), 1);
  EXPECT_EQ(roughness_factor(50, dsp::Radians(0), infrared), 1);
  EXPECT_LT(roughness_factor(50, dsp::Radians(1), infrared), 1e-100);
}

TEST(Ament, RoughnessTimesSineIsWhatCounts) {
  const double g = std::asin(0.01), twice = std::asin(0.02);
  EXPECT_NEAR(roughness_factor(4, dsp::Radians(g), infrared),
              roughness_factor(2, dsp::Radians(twice), infrared), 1e-12);
}

TEST(Mirror, ShareIsFresnelTimesAment) {
  const Floor floor{.refractive_index = 1.6, .roughness_um = 3};
  for (double g : {0.001, 0.02, 0.3, 1.2}) {
    EXPECT_NEAR(
        mirrored_share(floor, std::sin(g), infrared),
        fresnel_reflectance(1.6, dsp::Radians(g)) * roughness_factor(3, dsp::Radians(g), infrared),
        1e-12);
  }
}

TEST(Mirror, MetalTakesItsShareOfWhatTheSurfaceLetsIn) {
  const Floor bare{.refractive_index = 1, .metal_reflectance = 1};
  const Floor glass{.refractive_index = 1.5, .metal_reflectance = .9};
  for (double sin_grazing : {0.0, 1e-3, .02, .3, 1.0}) {
    EXPECT_EQ(mirrored_share(bare, sin_grazing, infrared), 1);
    const double surface = fresnel_reflectance(1.5, dsp::Radians(std::asin(sin_grazing)));
    EXPECT_NEAR(mirrored_share(glass, sin_grazing, infrared), 1 - (1 - surface) * .1, 1e-12);
  }
}

// All that leaves a unit of light: its mirror image and what the layer scatters upward.
double light_back(const Floor& floor, double sin_in) {
  constexpr int steps = 2000;
  double sum = 0;  // of brdf * sin_out dOmega, dOmega = 2 pi d(sin_out)
  for (int i = 0; i < steps; ++i) {
    const double sin_out = (i + 0.5) / steps;
    sum += diffuse_brdf(floor, sin_in, sin_out, infrared) * sin_out * 2 * pi / steps;
  }
  return sum + mirrored_share(floor, sin_in, infrared);
}

TEST(Diffuse, NeverGivesBackMoreThanCame) {
  for (double n : {1.0, 1.3, 1.5, 3.0}) {
    for (double roughness : {0.0, 0.3, 5.0}) {
      for (double sin_in : {0.0, 1e-3, .02, .3, .7, 1.0}) {
        for (double metal : {0.0, 0.5, 1.0}) {
          const Floor floor{n, roughness, 1.0, metal};
          EXPECT_LE(light_back(floor, sin_in), 1 + 1e-6) << n << ' ' << roughness << ' ' << metal;
        }
      }
    }
  }
}

TEST(Diffuse, BareLayerGivesBackItsReflectance) {
  for (double rho : {0.1, 0.5, 1.0}) EXPECT_NEAR(light_back({1, 0, rho}, 0.3), rho, 1e-6);
}

TEST(Diffuse, LightTakenFromTheImageJoinsTheScatteredPart) {
  const Floor smooth{1.5, 0, 0.5}, rough{1.5, 5, 0.5};
  EXPECT_GT(diffuse_brdf(rough, .02, .5, infrared), 2 * diffuse_brdf(smooth, .02, .5, infrared));
}

TEST(Diffuse, IsReciprocal) {
  const Floor floor{1.5, 2, 0.4};
  EXPECT_DOUBLE_EQ(diffuse_brdf(floor, .02, .7, infrared), diffuse_brdf(floor, .7, .02, infrared));
}

}  // namespace
}  // namespace channel
