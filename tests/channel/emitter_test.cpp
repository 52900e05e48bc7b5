#include "channel/emitter.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace channel {
namespace {

// TSAL6200, Vishay 81010 rev 2.4: radiant intensity from Fig. 5, pattern from Fig. 9 (mean of both
// sides), both digitised from the figures' vector paths.
EmitterData tsal6200() {
  return {
      .name = "TSAL6200",
      .intensity_mw_per_sr = {{1.1, 2, 5, 10, 20, 50, 100, 200, 400, 500, 900},
                              {.67, 1.12, 3.17, 6.79, 14.3, 37.0, 72.3, 145, 283, 347, 567}},
      .pattern = {{0, 5, 10, 15, 17, 20, 25, 30, 40, 50, 60, 70, 80, 90},
                  {1, .952, .807, .60, .513, .389, .21, .088, .063, .046, .032, .020, .010, 0}}};
}

double intensity(double ma) {
  return axial_intensity(tsal6200(), dsp::Amperes(ma * 1e-3)).value * 1e3;
}

double relative(double deg) { return relative_intensity(tsal6200(), dsp::degrees(deg)); }

TEST(Emitter, HasTheSheetsIntensityAtTheSheetsCurrents) {  // T1: 72.3 mW/sr at 100 mA
  const Curve figure = tsal6200().intensity_mw_per_sr;
  for (std::size_t i = 0; i < figure.x.size(); ++i) {
    EXPECT_NEAR(intensity(figure.x[i]), figure.y[i], 1e-9);
  }
}

TEST(Emitter, MeetsTheFigureBetweenTheTypedPoints) {  // Fig. 5 at currents not in the table above
  EXPECT_NEAR(intensity(3.41415), 2.0949, 0.02 * 2.0949);
  EXPECT_NEAR(intensity(9.01724), 6.0444, 0.02 * 6.0444);
  EXPECT_NEAR(intensity(481.952), 336.19, 0.01 * 336.19);
}

TEST(Emitter, IsAPowerLawBetweenTwoPoints) {
  const EmitterData square{"", {{10, 1000}, {3, 30000}}, {{0}, {1}}};
  for (double ma : {10.0, 31.6, 100.0, 500.0, 999.0}) {
    EXPECT_NEAR(axial_intensity(square, dsp::Amperes(ma * 1e-3)).value, 3e-5 * ma * ma,
                1e-12 * ma * ma);
  }
}

TEST(Emitter, IsProportionalBelowTheFirstPoint) {
  EXPECT_EQ(intensity(0), 0);
  EXPECT_NEAR(intensity(0.55), .67 / 2, 1e-12);
  EXPECT_NEAR(intensity(1.1 - 1e-9), .67, 1e-8);
}

TEST(Emitter, IsConstantAboveTheLastPoint) { EXPECT_DOUBLE_EQ(intensity(5000), 567); }

TEST(Emitter, IntensityRisesWithCurrent) {
  for (double ma = 0.05; ma < 890; ma *= 1.07) EXPECT_LT(intensity(ma), intensity(ma * 1.07));
}

TEST(Emitter, HasTheSheetsPattern) {  // T2, 81010 Fig. 9
  EXPECT_EQ(relative(0), 1);
  EXPECT_NEAR(relative(17), .51, .03);
  EXPECT_NEAR(relative(25), .21, .03);
  EXPECT_NEAR(relative(40), .063, .03 * .063);
}

TEST(Emitter, PatternMeetsTheFigureBetweenTheTypedPoints) {  // raw points of Fig. 9, one side
  EXPECT_NEAR(relative(8.26226), .87373, .02);
  EXPECT_NEAR(relative(14.0496), .65236, .02);
  EXPECT_NEAR(relative(22.8584), .28624, .03);
  EXPECT_NEAR(relative(62.0578), .029072, .002);
}

TEST(Emitter, CosinePowerHoldsOnlyInsideTheBeam) {  // 15.5 = ln(1/2) / ln(cos 17 deg)
  const auto cosine = [](double deg) { return std::pow(std::cos(dsp::degrees(deg).value), 15.5); };
  for (double deg : {0.0, 5.0, 10.0, 17.0, 20.0, 25.0}) {
    EXPECT_NEAR(relative(deg), cosine(deg), .03) << deg;
  }
  EXPECT_GT(relative(50), 10 * cosine(50));
}

TEST(Emitter, AHalfAngleAloneMakesACosinePower) {  // ln(1/2) / ln(cos phi)
  const double half_angle_and_power[][2] = {{10, 45.3}, {17, 15.5}, {22, 9.2},
                                            {25, 7.05}, {45, 2.0},  {60, 1.0}};
  for (const auto& [deg, m] : half_angle_and_power) {
    EXPECT_NEAR(cosine_power(dsp::degrees(deg)), m, .005 * m);
    const EmitterData led{
        .name = "", .intensity_mw_per_sr = {{1}, {1}}, .pattern = {}, .half_angle_deg = deg};
    EXPECT_EQ(relative_intensity(led, {}), 1);
    EXPECT_NEAR(relative_intensity(led, dsp::degrees(deg)), .5, 1e-12);
    EXPECT_NEAR(relative_intensity(led, dsp::degrees(30)),
                std::pow(std::cos(dsp::degrees(30).value), cosine_power(dsp::degrees(deg))), 1e-12);
    EXPECT_EQ(relative_intensity(led, dsp::degrees(91)), 0);
  }
}

// 81010 Fig. 7, some of its digitised points.
TEST(Emitter, FadesWithTemperatureAsTheFigure) {  // T3: .577 at 85 C
  EmitterData led = tsal6200();
  led.relative_intensity_against_temperature = {
      {-10, 0.533881, 21.2743, 25.8084, 39.9942, 60.9521, 81.3534, 86.2566, 100.258},
      {1.354, 1.2356, 1.0353, 0.99558, 0.8789, 0.72556, 0.59772, 0.57044, 0.50127}};
  const auto relative = [&](double celsius) {
    return axial_intensity(led, dsp::Amperes(.1), celsius) / axial_intensity(led, dsp::Amperes(.1));
  };
  EXPECT_NEAR(relative(85), .577, .03);
  EXPECT_NEAR(relative(-10), 1.35, .01);
  EXPECT_NEAR(relative(60), .73, .01);
  EXPECT_EQ(relative(25), 1);
  EXPECT_DOUBLE_EQ(axial_intensity(led, dsp::Amperes(.1)).value, 72.3e-3);
}

TEST(Emitter, WithoutACurveTemperatureChangesNothing) {
  EXPECT_EQ(axial_intensity(tsal6200(), dsp::Amperes(.1), 85).value * 1e3, intensity(100));
}

TEST(Emitter, GrowsRedderWithTemperature) {  // 81010 rev 2.4, basic characteristics: 0.2 nm/K
  EXPECT_DOUBLE_EQ(wavelength(tsal6200()).value, 940e-9);
  EXPECT_NEAR(wavelength(tsal6200(), 85).value, 952e-9, 1e-15);
  EXPECT_NEAR(wavelength(tsal6200(), -10).value, 933e-9, 1e-15);
}

TEST(Emitter, IsDarkBehind) {
  const EmitterData isotropic{"", {{1}, {1}}, {{0}, {1}}};
  EXPECT_EQ(relative_intensity(isotropic, dsp::degrees(90)), 1);
  for (double deg : {90.001, 120.0, 180.0}) {
    EXPECT_EQ(relative_intensity(isotropic, dsp::degrees(deg)), 0);
  }
}

}  // namespace
}  // namespace channel
