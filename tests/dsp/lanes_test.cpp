// Eight equals one: every operation of Lanes8 gives, lane by lane, the bits that float gives.
#include "dsp/lanes.hpp"

#include <cmath>
#include <limits>
#include <random>

#include "gtest/gtest.h"

namespace dsp {
namespace {

constexpr float awkward[] = {0.0f, -0.0f, 1.0f,   -1.5f,  1e-38f, 3e38f,      -2.5e-39f,
                             0.1f, 7.0f,  1e-20f, -1e20f, 0.5f,   123456.789f};

class LanesAgree : public ::testing::Test {
 protected:
  std::mt19937 random_{7};

  float draw() {
    if (random_() % 8 == 0) return awkward[random_() % std::size(awkward)];
    return std::ldexp(static_cast<float>(static_cast<std::int32_t>(random_())),
                      static_cast<int>(random_() % 40) - 50);
  }
  Lanes8 draw_lanes() {
    Lanes8 a;
    for (int i = 0; i < 8; ++i) set_lane(a, i, draw());
    return a;
  }

  template <class Op>
  void expect_equal(Op op) {
    for (int n = 0; n < 2000; ++n) {
      const Lanes8 a = draw_lanes(), b = draw_lanes(), c = draw_lanes();
      const auto all = op(a, b, c);
      for (int i = 0; i < 8; ++i) {
        const auto one = op(lane(a, i), lane(b, i), lane(c, i));
        ASSERT_TRUE(same(lane(all, i), one)) << lane(a, i) << " " << lane(b, i);
      }
    }
  }
  static bool same(float a, float b) { return to_bits(a) == to_bits(b) || (a != a && b != b); }
  static bool same(bool a, bool b) { return a == b; }
};

TEST_F(LanesAgree, Arithmetic) {
  expect_equal([](auto a, auto b, auto) { return a + b; });
  expect_equal([](auto a, auto b, auto) { return a - b; });
  expect_equal([](auto a, auto b, auto) { return a * b; });
  expect_equal([](auto a, auto b, auto) { return a / b; });
  expect_equal([](auto a, auto, auto) { return -a; });
  expect_equal([](auto a, auto b, auto c) { return fused(a, b, c); });
  expect_equal([](auto a, auto, auto) { return square_root(a); });
}

TEST_F(LanesAgree, ComparisonAndChoice) {
  expect_equal([](auto a, auto b, auto) { return a < b; });
  expect_equal([](auto a, auto b, auto) { return a >= b; });
  expect_equal([](auto a, auto b, auto c) { return choose(a > b, b, c); });
  expect_equal([](auto a, auto b, auto c) { return (a > b) & !(b <= c); });
  expect_equal([](auto a, auto b, auto) { return larger(a, b); });
  expect_equal([](auto a, auto b, auto) { return smaller(a, b); });
}

TEST_F(LanesAgree, Words) {
  expect_equal([](auto a, auto b, auto) { return from_bits((to_bits(a) << 3) ^ to_bits(b)); });
  expect_equal([](auto a, auto b, auto) { return to_float((to_bits(a) + to_bits(b)) >> 1); });
  expect_equal([](auto a, auto, auto) { return to_float(arithmetic_shift(to_bits(a), 23)); });
}

TEST_F(LanesAgree, SignedWords) {
  const auto float_of = [](auto w) { return from_bits(w); };
  expect_equal([](auto a, auto b, auto) { return exceeds(to_bits(a), to_bits(b)); });
  expect_equal(
      [=](auto a, auto b, auto) { return float_of(larger_signed(to_bits(a), to_bits(b))); });
  expect_equal(
      [=](auto a, auto b, auto) { return float_of(smaller_signed(to_bits(a), to_bits(b))); });
  expect_equal([=](auto a, auto b, auto c) { return float_of(kept(a < b, to_bits(c))); });
}

TEST(Lanes, SignedWordsKnowTheirSign) {
  const std::uint32_t minus_one = 0xFFFFFFFFu;
  EXPECT_TRUE(exceeds(1u, minus_one));
  EXPECT_EQ(larger_signed(1u, minus_one), 1u);
  EXPECT_EQ(smaller_signed(1u, minus_one), minus_one);
}

TEST(Lanes, AnySeesEveryLane) {
  EXPECT_FALSE(any(Mask8(false)));
  for (int i = 0; i < 8; ++i) {
    Lanes8 a(0.0f);
    set_lane(a, i, 1.0f);
    EXPECT_TRUE(any(a > Lanes8(0.5f))) << i;
  }
}

TEST(Lanes, LargerDropsANaNOnTheLeft) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(larger(nan, 2.0f), 2.0f);
  EXPECT_EQ(lane(larger(Lanes8(nan), Lanes8(2.0f)), 3), 2.0f);
}

}  // namespace
}  // namespace dsp
