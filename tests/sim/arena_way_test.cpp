// A receiver's way: places, headings and times by what a ruler and a watch say.
#include <cmath>
#include <numbers>

#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/arena/trajectory.hpp"

namespace sim {
namespace {

using dsp::Seconds;

double heading_deg(const Trajectory& way, double t) {
  return way.at(Seconds(t)).heading.value * 180 / std::numbers::pi;
}

void expect_at(const Trajectory& way, double t, double x, double y, double degrees) {
  const Pose2D place = way.at(Seconds(t));
  EXPECT_NEAR(place.x, x, 1e-9) << t;
  EXPECT_NEAR(place.y, y, 1e-9) << t;
  EXPECT_NEAR(std::remainder(heading_deg(way, t) - degrees, 360), 0, 1e-9) << t;
}

std::string refusal_of(const PathSettings& path) {
  try {
    const Trajectory way(path);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

TEST(Trajectory, OnePlaceIsNoWay) {
  const Trajectory way({.x_m = "2", .y_m = "-1"});
  EXPECT_EQ(way.duration(), Seconds(0));
  EXPECT_EQ(way.distance(Seconds(9)), 0);
  expect_at(way, 0, 2, -1, 0);
  expect_at(way, 1e6, 2, -1, 0);
  expect_at(Trajectory({.heading_deg = "70"}), 5, 0, 0, 70);
}

// 4 m at 2 m/s, a quarter turn at 45 degrees a second, 3 m.
TEST(Trajectory, LooksWhereItGoesAndTurnsOnTheSpot) {
  const Trajectory way({.x_m = "0,4,4", .y_m = "0,0,3", .speed_m_per_s = 2, .turn_deg_per_s = 45});
  EXPECT_NEAR(way.duration().value, 2 + 2 + 1.5, 1e-12);
  expect_at(way, -1, 0, 0, 0);
  expect_at(way, 1, 2, 0, 0);
  expect_at(way, 3, 4, 0, 45);
  expect_at(way, 4.75, 4, 1.5, 90);
  expect_at(way, 99, 4, 3, 90);  // it stays where the way ends
  EXPECT_NEAR(way.distance(Seconds(1)), 2, 1e-12);
  EXPECT_NEAR(way.distance(Seconds(3)), 4, 1e-12);
  EXPECT_NEAR(way.distance(Seconds(99)), 7, 1e-12);
}

TEST(Trajectory, HasItsCornersInOrder) {
  const auto corners =
      Trajectory({.x_m = "0,4,4", .y_m = "0,0,3", .speed_m_per_s = 2, .turn_deg_per_s = 45})
          .corners();
  ASSERT_EQ(corners.size(), 4U) << "and the turn, which stays where it is";
  EXPECT_EQ(corners[0].x, 0);
  EXPECT_EQ(corners[1].x, 4);
  EXPECT_EQ(corners[2].x, 4);
  EXPECT_EQ(corners[3].y, 3);
  EXPECT_EQ(Trajectory({.x_m = "2", .y_m = "-1"}).corners().at(0).x, 2);
}

TEST(Trajectory, BeginsAsItSetsOutAndSkipsAPlaceWhereItIs) {
  const Trajectory way(
      {.x_m = "1,1,1,0", .y_m = "1,1,0,0", .speed_m_per_s = 1, .turn_deg_per_s = 90});
  expect_at(way, 0, 1, 1, -90);
  EXPECT_NEAR(way.duration().value, 1 + 1 + 1, 1e-12);  // a quarter turn back to -180
  expect_at(way, 1.5, 1, 0, -135);
}

TEST(Trajectory, TurnsTheShorterWayRound) {
  // From 135 to -135 degrees: 90 through 180.
  const Trajectory way(
      {.x_m = "0,-1,-2", .y_m = "0,1,0", .speed_m_per_s = 1, .turn_deg_per_s = 90});
  const double leg = std::numbers::sqrt2;
  EXPECT_NEAR(way.duration().value, 2 * leg + 1, 1e-12);
  expect_at(way, leg + 0.5, -1, 1, 180);
}

TEST(Trajectory, GivenHeadingsChangeEvenlyAlongTheWay) {
  const Trajectory way({.x_m = "0,2,2,4", .heading_deg = "0,90,-90,180", .speed_m_per_s = 1});
  expect_at(way, 1, 1, 0, 45);
  expect_at(way, 2, 2, 0, 90);
  EXPECT_NEAR(way.duration().value, 2 + 2 + 2, 1e-12);  // half a turn at 90 degrees a second
  expect_at(way, 5, 3, 0, -135);
  EXPECT_NEAR(way.distance(Seconds(3)), 2, 1e-12);
}

TEST(Trajectory, OneNumberHoldsForAll) {
  const Trajectory way({.x_m = "0:1:3", .y_m = "5", .heading_deg = "30", .speed_m_per_s = 1});
  EXPECT_NEAR(way.duration().value, 3, 1e-12);
  expect_at(way, 2.5, 2.5, 5, 30);
}

TEST(Trajectory, ListsThatDoNotFitAreRefused) {
  EXPECT_EQ(refusal_of({.x_m = "0,1,2", .y_m = "0,1"}),
            "path.y_m has 2 numbers (the way has 3 way-points) give one or 3");
  EXPECT_EQ(refusal_of({.x_m = "0,1", .heading_deg = "0,1,2"}),
            "path.x_m has 2 numbers (the way has 3 way-points) give one or 3");
}

// Speed and direction: what lies between two moments is never farther than the speed takes it.
TEST(Trajectory, NeverJumps) {
  const Trajectory way({.x_m = "0,1,1,-2,0.5", .y_m = "0,0,3,-1,0.5", .speed_m_per_s = 0.7});
  double length = 0;
  constexpr double step = 1e-3;
  for (double t = 0; t < way.duration().value; t += step) {
    const Pose2D a = way.at(Seconds(t)), b = way.at(Seconds(t + step));
    const double moved = std::hypot(b.x - a.x, b.y - a.y);
    EXPECT_LE(moved, 0.7 * step * (1 + 1e-9));
    EXPECT_LE(std::fabs(std::remainder(heading_deg(way, t + step) - heading_deg(way, t), 360)),
              90 * step * (1 + 1e-9));
    EXPECT_NEAR(way.distance(Seconds(t)), length, 2e-3);
    length += moved;
  }
  EXPECT_GT(length, 9);
}

}  // namespace
}  // namespace sim
