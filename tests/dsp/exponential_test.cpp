#include "dsp/exponential.hpp"

#include <cmath>

#include "gtest/gtest.h"

namespace dsp {
namespace {

TEST(PowerOfTwo, IsWithinItsBound) {
  double worst = 0;
  for (float x = -125; x < 125; x += 0.0137f) {
    const double exact = std::exp2(static_cast<double>(x));
    worst = std::max(worst, std::abs(static_cast<double>(power_of_two(x)) / exact - 1));
  }
  EXPECT_LT(worst, 3e-7);
  EXPECT_EQ(power_of_two(0.0f), 1.0f);
  EXPECT_EQ(power_of_two(20.0f), 0x1p20f);
}

TEST(PowerOfTwo, EightEqualOne) {
  for (float x = -20; x < 40; x += 0.37f) {
    Lanes8 eight(x);
    set_lane(eight, 3, x / 3);
    const Lanes8 y = power_of_two(eight);
    EXPECT_EQ(lane(y, 0), power_of_two(x));
    EXPECT_EQ(lane(y, 3), power_of_two(x / 3));
  }
}

}  // namespace
}  // namespace dsp
