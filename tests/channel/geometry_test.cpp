// Poses, the direct ray, the mirror image, and laws that hold for all light.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "light_scene.hpp"

namespace channel {
namespace {

using std::numbers::pi;

TEST(ReceiverPose, LooksBackAtTheLed) {
  const Pose pose = receiver_pose(dsp::Metres(2), dsp::degrees(30), dsp::Metres(.5),
                                  dsp::degrees(10), dsp::degrees(-5));
  EXPECT_NEAR(pose.x, std::sqrt(3), 1e-12);
  EXPECT_NEAR(pose.y, 1, 1e-12);
  EXPECT_EQ(pose.z, .5);
  EXPECT_NEAR(pose.yaw.value, dsp::degrees(220).value, 1e-12);
  EXPECT_EQ(pose.elevation, dsp::degrees(-5));
}

TEST(Direct, FallsWithTheSquareOfDistance) {  // P1
  const auto direct = [](double d) { return level_link(15.5, 1, d, .01, no_floor).direct.value; };
  EXPECT_DOUBLE_EQ(direct(1), 1);
  EXPECT_DOUBLE_EQ(direct(2), direct(1) / 4);
  EXPECT_DOUBLE_EQ(direct(4), direct(1) / 16);
}

TEST(Direct, Tsal6200GivesItsIntensityAtOneMetre) {  // T1: Vishay 81010 rev 2.4 Fig. 5, 100 mA
  const EmitterData led{"TSAL6200", {{50, 100, 200}, {37.0, 72.3, 145}}, {{0, 10}, {1, .807}}};
  const ReceivedLight light = received_light(led, axial_intensity(led, dsp::Amperes(.1)),
                                             at(0, 0, .01), cosine(1), facing(1, .01), no_floor);
  EXPECT_NEAR(light.total().value, 72.3e-3, 1e-6);
}

TEST(Direct, BothPatternsApply) {
  const ReceivedLight light = received_light(cosine_led(3), one_watt, at(0, 0, .2, 20, 10),
                                             cosine(2), at(2, 0, .2, 180 - 35, 0), no_floor);
  const double emitted = std::pow(std::cos(pi / 9) * std::cos(pi / 18), 3);
  const double accepted = std::pow(std::cos(dsp::degrees(35).value), 2);
  EXPECT_NEAR(light.direct.value, emitted * accepted / 4, 1e-5);
}

TEST(Direct, YawFollowsTheSquaredDistanceCurve) {  // R17
  // TSOP48, Vishay 82459 rev 1.8 Fig. 11, relative distance, digitised (right half).
  const Directivity tsop48{
      {{0, 9.94667, 19.7759, 29.7004, 39.5541, 49.5902, 59.6158, 69.4925, 79.6564, 90},
       {1, .96005, .84259, .7105, .57253, .44859, .34745, .23289, .12817, .021482}}};
  const double yaw_and_response[][2] = {{0, 1}, {30, .499}, {45, .255}, {60, .118}, {80, .016}};
  for (const auto& [yaw, response] : yaw_and_response) {
    for (double side : {-1.0, 1.0}) {
      const Pose receiver = receiver_pose(dsp::Metres(1), dsp::Radians(0), dsp::Metres(.01),
                                          dsp::degrees(side * yaw), {});
      const ReceivedLight light =
          received_light(cosine_led(15.5), one_watt, at(0, 0, .01), tsop48, receiver, no_floor);
      EXPECT_NEAR(light.direct.value, response, .02) << yaw;
    }
  }
}

// A receiver that sees 1 ahead, .8 of the distance 30 degrees above and .4 as far below.
TEST(Direct, TiltFollowsTheVerticalCurve) {
  const Directivity lopsided{{{0, 30, 90}, {1, .6, 0}}, {{-90, -30, 0, 30, 90}, {0, .4, 1, .8, 0}}};
  const auto response = [&](double yaw, double tilt) {
    const Pose receiver = receiver_pose(dsp::Metres(1), dsp::Radians(0), dsp::Metres(.01),
                                        dsp::degrees(yaw), dsp::degrees(tilt));
    return received_light(cosine_led(15.5), one_watt, at(0, 0, .01), lopsided, receiver, no_floor)
        .direct.value;
  };
  EXPECT_NEAR(response(0, 0), 1, 1e-6);
  EXPECT_NEAR(response(30, 0), .36, 1e-6);
  EXPECT_NEAR(response(-30, 0), .36, 1e-6);
  EXPECT_NEAR(response(0, 30), .16, 1e-6);  // looks up: the LED is below its axis
  EXPECT_NEAR(response(0, -30), .64, 1e-6);
}

TEST(Direct, NothingBehindLedOrReceiver) {
  const EmitterData isotropic{"", {{1}, {1}}, {{0}, {1}}};
  const auto light = [&](double led_yaw, double receiver_yaw) {
    return received_light(isotropic, one_watt, at(0, 0, .01, led_yaw), cosine(0),
                          at(1, 0, .01, receiver_yaw), {});
  };
  EXPECT_GT(light(0, 180).total().value, 1);
  EXPECT_EQ(light(180, 180).total().value, 0);
  EXPECT_EQ(light(0, 0).total().value, 0);
}

TEST(Specular, PerfectMirrorAddsTheImageSource) {  // P2
  const EmitterData isotropic{"", {{1}, {1}}, {{0}, {1}}};
  const Floor mirror{.refractive_index = 1, .metal_reflectance = 1};
  for (double d : {.1, 1.0, 5.0}) {
    const ReceivedLight light =
        received_light(isotropic, one_watt, at(0, 0, .01), cosine(0), facing(d, .01), mirror);
    EXPECT_NEAR(light.specular / light.direct, d * d / (d * d + 4e-4), 1e-5);
  }
}

TEST(Specular, VarnishNearlyDoublesTheLightAtOneMetre) {  // P2: n = 1.5, smooth
  const EmitterData isotropic{"", {{1}, {1}}, {{0}, {1}}};
  const ReceivedLight light =
      received_light(isotropic, one_watt, at(0, 0, .01), cosine(0), facing(1, .01), {});
  EXPECT_NEAR(light.total() / light.direct, 1.891, .001);
}

TEST(Specular, LeavesAndArrivesFromBelowTheAxes) {
  const double led_h = .1, receiver_h = .3, d = .5;
  const double down = std::atan((led_h + receiver_h) / d) * 180 / pi;
  const Floor floor{.refractive_index = 1.5, .roughness_um = .05};
  const auto specular = [&](double led_elevation, double receiver_elevation) {
    return received_light(cosine_led(45), one_watt, at(0, 0, led_h, 0, led_elevation), cosine(4),
                          at(d, 0, receiver_h, 180, receiver_elevation), floor)
        .specular.value;
  };
  const double path2 = d * d + (led_h + receiver_h) * (led_h + receiver_h);
  const double share = fresnel_reflectance(1.5, dsp::degrees(down)) *
                       roughness_factor(.05, dsp::degrees(down), dsp::Metres(940e-9));
  EXPECT_NEAR(specular(-down, -down), share / path2, 1e-9);
  const double cos_down = std::cos(dsp::degrees(down).value);
  EXPECT_NEAR(specular(0, -down) / specular(-down, -down), std::pow(cos_down, 45), 1e-4);
  EXPECT_NEAR(specular(-down, 0) / specular(-down, -down), std::pow(cos_down, 4), 1e-9);
}

TEST(ReceivedLight, AWarmLedsLongerWavesSeeASmootherFloor) {
  const Floor floor{.refractive_index = 1.5, .roughness_um = 5};
  const auto specular = [&](double celsius) {
    return received_light(cosine_led(1), one_watt, at(0, 0, .01), cosine(1), facing(1, .01), floor,
                          celsius)
        .specular.value;
  };
  const double grazing = std::atan(.02);
  const auto left = [&](double nm) {
    return roughness_factor(5, dsp::Radians(grazing), dsp::Metres(nm * 1e-9));
  };
  EXPECT_NEAR(specular(85) / specular(25), left(952) / left(940), 1e-12);
}

TEST(Flux, AHorizontalLedSendsHalfItsLightToTheFloor) {  // P4
  for (double m : {1.0, 4.0, 15.5, 45.0}) {
    for (double h : {1e-4, .01, 2.0}) {
      const double flux = flux_onto_floor(cosine_led(m), one_watt, at(1, 2, h, 77));
      EXPECT_NEAR(flux, pi / (m + 1), .005 * pi / (m + 1)) << m << ' ' << h;
    }
  }
}

TEST(Flux, WhatMissesTheFloorIsWhatTheUpturnedLedSends) {
  const double all = 2 * pi / (15.5 + 1);
  for (double up : {1.0, 5.0, 20.0, 60.0, 90.0}) {
    const EmitterData led = cosine_led(15.5);
    const double down = flux_onto_floor(led, one_watt, at(0, 0, .01, 0, -up));
    const double rest = flux_onto_floor(led, one_watt, at(0, 0, .01, 0, up));
    EXPECT_NEAR(down + rest, all, .005 * all) << up;
    EXPECT_GT(down, rest);
  }
}

TEST(ReceivedLight, LedAndReceiverMayChangePlaces) {
  const Floor floor{1.5, 1, .7};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-.5, .5), height(.002, .5), turn(-60, 60),
      dip(-40, 40);
  for (int i = 0; i < 5; ++i) {
    const Pose a = at(place(random), place(random), height(random), turn(random), dip(random));
    const Pose b =
        at(2 + place(random), place(random), height(random), 180 + turn(random), dip(random));
    const auto there = received_light(cosine_led(2), one_watt, a, cosine(2), b, floor);
    const auto back = received_light(cosine_led(2), one_watt, b, cosine(2), a, floor);
    EXPECT_NEAR(there.direct.value, back.direct.value, 1e-4 * there.direct.value + 1e-9);
    EXPECT_NEAR(there.specular.value, back.specular.value, 1e-4 * there.specular.value + 1e-9);
    EXPECT_NEAR(there.diffuse.value, back.diffuse.value, 2e-3 * there.diffuse.value + 1e-9);
  }
}

TEST(ReceivedLight, TurningMovingOrMirroringTheSceneChangesNothing) {
  const Floor floor{1.5, 1, .7};
  const auto light = [&](double turn, double x0, double side) {
    const double c = std::cos(dsp::degrees(turn).value), s = std::sin(dsp::degrees(turn).value);
    const auto moved = [&](double x, double y, double z, double yaw, double elevation) {
      y *= side;
      return at(x0 + c * x - s * y, s * x + c * y, z, turn + side * yaw, elevation);
    };
    return received_light(cosine_led(15.5), one_watt, moved(0, 0, .02, 10, 3), cosine(1),
                          moved(.8, .1, .05, 170, -5), floor);
  };
  const ReceivedLight reference = light(0, 0, 1);
  for (const auto& [turn, x0, side] :
       {std::tuple{50.0, 0.0, 1.0}, {0.0, 3.0, 1.0}, {-120.0, 1.0, -1.0}}) {
    const ReceivedLight moved = light(turn, x0, side);
    EXPECT_NEAR(moved.direct / reference.direct, 1, 1e-9);
    EXPECT_NEAR(moved.specular / reference.specular, 1, 1e-9);
    EXPECT_NEAR(moved.diffuse / reference.diffuse, 1, 1e-9);
  }
}

TEST(ReceivedLight, IsFiniteInEveryCorner) {
  const Floor floor{1.5, 5, .3};
  const EmitterData led = cosine_led(15.5);
  for (double d : {0.0, .001, 100.0}) {
    for (double led_h : {0.0, 1e-4, .01, 3.0}) {
      for (double receiver_h : {2e-4, .02, 2.0}) {
        for (double elevation : {-90.0, 0.0, 90.0}) {
          for (double yaw : {0.0, 180.0}) {
            const ReceivedLight light =
                received_light(led, one_watt, at(0, 0, led_h, 0, elevation), cosine(4),
                               at(d, 0, receiver_h, yaw, -elevation), floor);
            for (const auto part : {light.direct, light.specular, light.diffuse}) {
              EXPECT_TRUE(std::isfinite(part.value) && part.value >= 0);
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace channel
