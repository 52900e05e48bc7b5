// What the floor scatters, and what a bump takes away.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "light_scene.hpp"

namespace channel {
namespace {

using std::numbers::pi;

TEST(Diffuse, MeetsTheTabulatedRatios) {
  // E_diff / E_dir of a white Lambertian floor at 10 mm: an independent patch integration.
  struct Row {
    double m, n, d, ratio;
  };
  constexpr Row table[] = {{1, 1, .1, .136},     {1, 1, .3, .0420},    {1, 1, 1, .0112},
                           {1, 1, 3, .0035},     {15.5, 1, .1, .0571}, {15.5, 1, .3, .0223},
                           {15.5, 1, 1, .0062},  {15.5, 1, 3, .0020},  {15.5, 4, .1, .0295},
                           {15.5, 4, .3, .0119}, {15.5, 4, 1, .0031},  {15.5, 4, 3, .0010}};
  for (const Row& row : table) {
    EXPECT_NEAR(diffuse_ratio(row.m, row.n, row.d, .01), row.ratio, .01 * row.ratio + 5e-5)
        << row.m << ' ' << row.n << ' ' << row.d;
  }
}

TEST(Diffuse, LambertianFloorAtThreeMetres) {  // P3
  EXPECT_NEAR(diffuse_ratio(1, 1, 3, .01), .0035, .03 * .0035);
}

TEST(Diffuse, TendsToTheClosedForm) {  // (h / d) (1 / (m + 1) + 1 / (n + 1)) as h / d -> 0
  for (const auto& [m, n] : {std::pair{1.0, 1.0}, {15.5, 1.0}, {15.5, 4.0}, {1.0, 4.0}}) {
    for (double d : {.5, 3.0}) {
      const double limit = d * 1e-5 / d * (1 / (m + 1) + 1 / (n + 1));
      EXPECT_NEAR(diffuse_ratio(m, n, d, d * 1e-5), limit, .003 * limit) << m << ' ' << n;
    }
  }
}

bool shaded(double height, double top) { return std::abs(height) <= top; }

// Whether the bump hides (x, y) on the floor from either end, for a receiver on the x axis.
bool shaded_patch(double x, const Pose& led, const Pose& receiver, const Floor& floor) {
  const double bump = floor.bump_position * receiver.x, top = floor.bump_height_mm * 1e-3;
  if (top == 0) return false;
  if (x > bump) return shaded(led.z * (x - bump) / x, top);
  return shaded(receiver.z * (bump - x) / (receiver.x - x), top);
}

// The diffuse part once more: equal squares over a piece of floor, cosines as such.
double plain_diffuse(double m, double n, const Pose& led, const Pose& receiver,
                     const Floor& floor) {
  constexpr double cell = 2e-3, half_width = .7;
  const auto toward = [](const Pose& p, double x, double y, double r) {
    const double along = std::cos(p.elevation.value);
    const double dot = along * std::cos(p.yaw.value) * (x - p.x) +
                       along * std::sin(p.yaw.value) * (y - p.y) -
                       std::sin(p.elevation.value) * p.z;
    return std::max(dot / r, 0.0);
  };
  double sum = 0;
  for (double x = cell / 2 - half_width; x < half_width; x += cell) {
    for (double y = cell / 2 - half_width; y < half_width; y += cell) {
      const double r1 = std::hypot(x - led.x, y - led.y, led.z);
      const double r2 = std::hypot(x - receiver.x, y - receiver.y, receiver.z);
      const double cosines = std::pow(toward(led, x, y, r1), m) *
                             std::pow(toward(receiver, x, y, r2), n) * led.z * receiver.z;
      if (cosines <= 0 || shaded_patch(x, led, receiver, floor)) continue;
      sum += cosines / std::pow(r1 * r2, 3) *
             diffuse_brdf(floor, led.z / r1, receiver.z / r2, dsp::Metres(940e-9));
    }
  }
  return sum * cell * cell;
}

TEST(Diffuse, MatchesAPlainSumForAnyPose) {
  const struct {
    double m, n;
    Pose led, receiver;
    Floor floor;
  } scenes[] = {
      {1, 1, at(0, 0, .02), at(.06, 0, .02, 180), white},
      {3, 2, at(0, .01, .03, 40, -30), at(.05, -.02, .015, 150, -10), white},
      {15.5, 1, at(0, 0, .1, 30, -60), at(.02, .04, .02, 250, 20), {1.5, .1, .6}},
      {15.5, 1, at(0, 0, .03, 0, -20), at(.15, 0, .04, 180, 0), {1.5, 0, 1}},
      {1, 1, at(0, 0, .02, 0, -90), at(0, 0, .05, 0, -90), white},
      {3, 1, at(0, 0, .02, 0, -70), at(.001, 0, .021, 180, -70), white},
      {1, 1, at(0, 0, .02), at(.001, 0, .03), white},
  };
  for (const auto& c : scenes) {
    const double light =
        received_light(cosine_led(c.m), one_watt, c.led, cosine(c.n), c.receiver, c.floor)
            .diffuse.value;
    const double plain = plain_diffuse(c.m, c.n, c.led, c.receiver, c.floor);
    EXPECT_NEAR(light, plain, .01 * plain) << &c - scenes;
  }
}

Floor bumpy(Floor floor, double height_mm, double position = .5) {
  floor.bump_height_mm = height_mm;
  floor.bump_position = position;
  return floor;
}

TEST(Bump, ThrowsItsShadowOnTheScatteredLight) {
  // Bumps whose shadows end on the borders of the plain sum's squares.
  const Pose led = at(0, 0, .02, 0, -30), receiver = at(.06, 0, .03, 180, -30);
  for (const auto& [top_mm, position] : {std::pair{5.0, .5}, {10.0, 1 / 3.}, {15.0, .6}}) {
    const Floor floor = bumpy(white, top_mm, position);
    const double plain = plain_diffuse(3, 1, led, receiver, floor);
    const double light =
        received_light(cosine_led(3), one_watt, led, cosine(1), receiver, floor).diffuse.value;
    EXPECT_NEAR(light, plain, .01 * plain) << top_mm;
    EXPECT_LT(light, .9 * plain_diffuse(3, 1, led, receiver, white)) << top_mm;
  }
}

TEST(Bump, AsHighAsTheLineOfSightHidesTheLed) {
  for (double d : {.05, 1.0, 10.0}) {
    for (double position : {.01, .3, .5, .99}) {
      const auto light = [&](double top_mm) {
        return level_link(15.5, 1, d, 10 * 1e-3, bumpy({1.5, 0, 1}, top_mm, position));
      };
      EXPECT_EQ(light(10).total().value, 0) << d << ' ' << position;
      EXPECT_EQ(light(10.1).total().value, 0);
      EXPECT_EQ(light(9.99).direct, light(0).direct);
    }
  }
}

TEST(Bump, OfAnyHeightInTheMiddleHidesTheMirrorImageOfALevelLink) {
  const Floor floor{1.5, 0, 0};
  EXPECT_EQ(level_link(1, 1, 1, .01, bumpy(floor, .1)).specular.value, 0);
  // At a quarter of the way the mirrored ray passes half as high as the LED.
  EXPECT_EQ(level_link(1, 1, 1, .01, bumpy(floor, 5.1, .25)).specular.value, 0);
  EXPECT_EQ(level_link(1, 1, 1, .01, bumpy(floor, 4.9, .25)).specular,
            level_link(1, 1, 1, .01, floor).specular);
  EXPECT_EQ(level_link(1, 1, 1, .01, bumpy(floor, 4.9, .75)).specular,
            level_link(1, 1, 1, .01, floor).specular);
}

TEST(Bump, IsSeenOverFromAHigherReceiver) {
  const auto direct = [](double receiver_h, double position) {
    return received_light(cosine_led(1), one_watt, at(0, 0, .01), cosine(1), facing(1, receiver_h),
                          bumpy(no_floor, 20, position))
        .direct.value;
  };
  EXPECT_EQ(direct(.029, .5), 0);  // 19.5 mm above the bump
  EXPECT_GT(direct(.031, .5), 0);
  EXPECT_EQ(direct(.031, .4), 0);
  EXPECT_GT(direct(.031, .6), 0);
}

TEST(Bump, TurnsWithTheReceiversBearing) {
  for (double bearing : {-170.0, -60.0, 45.0, 90.0, 180.0}) {
    const Pose receiver =
        receiver_pose(dsp::Metres(1), dsp::degrees(bearing), dsp::Metres(.01), {}, {});
    const auto light = [&](double top_mm) {
      return received_light(cosine_led(1), one_watt, at(0, 0, .01, bearing), cosine(1), receiver,
                            bumpy(no_floor, top_mm));
    };
    EXPECT_EQ(light(10.01).total().value, 0) << bearing;
    EXPECT_EQ(light(9.99).total(), light(0).total()) << bearing;
  }
}

TEST(Bump, LeavesAReceiverRightAboveTheLedAlone) {
  const auto light = [](const Floor& floor) {
    return received_light(cosine_led(1), one_watt, at(0, 0, .01, 0, 90), cosine(1),
                          at(0, 0, .5, 0, -90), floor);
  };
  EXPECT_GT(light(white).direct.value, 0);
  EXPECT_EQ(light(bumpy(white, 100)).total(), light(white).total());
}

TEST(Diffuse, IsProportionalToReflectanceAndIntensity) {
  const auto diffuse = [](double rho, double watts) {
    return received_light(cosine_led(1), dsp::WattsPerSteradian(watts), at(0, 0, .01), cosine(1),
                          facing(.5, .01), {1, 0, rho})
        .diffuse.value;
  };
  EXPECT_EQ(diffuse(0, 1), 0);
  EXPECT_NEAR(diffuse(.6, .5), .3 * diffuse(1, 1), 1e-12);
}

}  // namespace
}  // namespace channel
