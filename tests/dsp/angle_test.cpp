#include "dsp/angle.hpp"

#include <cmath>
#include <numbers>

#include "gtest/gtest.h"

namespace dsp {
namespace {

constexpr double turn = 2 * std::numbers::pi;

TEST(Angle, TurnsAllTheWayRound) {
  for (int i = -499; i < 500; ++i) {
    const double at = i * 1e-3;
    const auto re = static_cast<float>(3 * std::cos(turn * at));
    const auto im = static_cast<float>(3 * std::sin(turn * at));
    EXPECT_NEAR(static_cast<double>(turns(re, im)), at, 3e-6);
  }
}

TEST(Angle, TurnsOfCosine) {
  for (int i = 0; i <= 1000; ++i) {
    const double x = i * 1e-3;
    EXPECT_NEAR(static_cast<double>(turns_of_cosine(static_cast<float>(x))), std::acos(x) / turn,
                1.2e-5);
  }
}

TEST(Angle, LanesAreTheSame) {
  Lanes8 re, im;
  for (int i = 0; i < 8; ++i) {
    set_lane(re, i, static_cast<float>(std::cos(i)));
    set_lane(im, i, static_cast<float>(std::sin(i)));
  }
  const Lanes8 all = turns(re, im), half = turns_of_cosine(larger(re, -re));
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(lane(all, i), turns(lane(re, i), lane(im, i)));
    EXPECT_EQ(lane(half, i), turns_of_cosine(std::fabs(lane(re, i))));
  }
}

}  // namespace
}  // namespace dsp
