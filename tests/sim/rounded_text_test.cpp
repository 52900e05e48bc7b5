#include "sim/text/rounded_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace sim {
namespace {

TEST(RoundedText, GoesOutwardsBeyondWhatIsNot) {
  EXPECT_EQ(fixed_text(0.0236, 3), "0.024");
  EXPECT_EQ(fixed_text(0.0236, 3, Rounding::down), "0.023");
  EXPECT_EQ(fixed_text(0.0234, 3, Rounding::up), "0.024");
  EXPECT_EQ(fixed_text(-0.0236, 3, Rounding::up), "-0.023");
  EXPECT_EQ(fixed_text(9.96, 1, Rounding::up), "10.0");
  EXPECT_EQ(scientific_text(1.2345e-4, 3, Rounding::up), "1.24e-4");
  EXPECT_EQ(scientific_text(1.999e-3, 2, Rounding::down), "1.9e-3");
  EXPECT_EQ(scientific_text(9.96e-3, 2, Rounding::up), "1.0e-2");
  EXPECT_EQ(significant_text(0.50001, 3, Rounding::up), "0.501");
  EXPECT_EQ(significant_text(1234, 3, Rounding::down), "1.23e+03");
}

// 0.29 * 100 is less than 29.
TEST(RoundedText, KeepsWhatHasNoMoreDigits) {
  for (const Rounding rounding : {Rounding::nearest, Rounding::down, Rounding::up}) {
    EXPECT_EQ(fixed_text(0.29, 2, rounding), "0.29");
    EXPECT_EQ(scientific_text(2.9e-3, 2, rounding), "2.9e-3");
    EXPECT_EQ(significant_text(0.29, 2, rounding), "0.29");
    EXPECT_EQ(scientific_text(0, 2, rounding), "0");
    EXPECT_EQ(significant_text(std::numeric_limits<double>::infinity(), 3, rounding), "inf");
  }
}

}  // namespace
}  // namespace sim
