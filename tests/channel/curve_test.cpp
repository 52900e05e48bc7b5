#include "channel/curve.hpp"

#include <gtest/gtest.h>

#include <random>

namespace channel {
namespace {

TEST(Curve, GoesThroughItsPoints) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(0.01, 3), level(-5, 5);
  Curve curve;
  double x = -10;
  for (int i = 0; i < 50; ++i) {
    curve.x.push_back(x += step(random));
    curve.y.push_back(level(random));
  }
  for (std::size_t i = 0; i < curve.x.size(); ++i) EXPECT_EQ(curve(curve.x[i]), curve.y[i]);
}

TEST(Curve, ReproducesAStraightLine) {
  const Curve curve{{0, 1, 5, 9}, {2, 5, 17, 29}};
  for (double x = 0; x <= 9; x += 0.125) EXPECT_NEAR(curve(x), 2 + 3 * x, 1e-12);
}

TEST(Curve, StaysBetweenItsNeighbours) {
  const Curve curve{{1, 2, 4}, {10, -10, 30}};
  EXPECT_DOUBLE_EQ(curve(1.25), 5);
  EXPECT_DOUBLE_EQ(curve(3), 10);
}

TEST(Curve, IsConstantBeyondItsEnds) {
  const Curve curve{{1, 2}, {10, 20}};
  EXPECT_EQ(curve(-1e9), 10);
  EXPECT_EQ(curve(0.999), 10);
  EXPECT_EQ(curve(1e9), 20);
}

TEST(Curve, OnePointIsAConstant) {
  const Curve curve{{3}, {7}};
  for (double x : {-1.0, 3.0, 8.0}) EXPECT_EQ(curve(x), 7);
}

TEST(Curve, KnowsThatItIsEmpty) {
  EXPECT_TRUE(Curve{}.empty());
  EXPECT_FALSE((Curve{{0}, {0}}).empty());
}

#ifndef NDEBUG
TEST(CurveDeathTest, EmptyCurveHasNoValue) { EXPECT_DEATH(Curve{}(1), "empty"); }
#endif

}  // namespace
}  // namespace channel
