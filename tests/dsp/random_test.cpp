// Philox by its published known answers; xoshiro and the normals by laws and by equality of lanes.
#include <algorithm>
#include <cmath>
#include <vector>

#include "dsp/normal.hpp"
#include "dsp/philox.hpp"
#include "gtest/gtest.h"

namespace dsp {
namespace {

// Known-answer vectors of philox4x32-10, Random123 distribution, kat_vectors.
TEST(Philox, KnownAnswers) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (PhiloxBlock{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
  constexpr std::uint32_t ones = 0xffffffffu;
  EXPECT_EQ(philox4x32({ones, ones, ones, ones}, {ones, ones}),
            (PhiloxBlock{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
  EXPECT_EQ(
      philox4x32({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, {0xa4093822u, 0x299f31d0u}),
      (PhiloxBlock{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}));
}

TEST(Philox, EveryPartOfAnAddressMatters) {
  const RandomAddress base{.seed = 5, .point = 6, .trial = 7, .purpose = 8};
  const auto first = base.block(0);
  EXPECT_NE(base.block(1), first);
  for (auto change : {0, 1, 2, 3, 4}) {
    RandomAddress other = base;
    if (change == 0) other.seed ^= 1;
    if (change == 1) other.seed ^= std::uint64_t{1} << 40;
    if (change == 2) other.point ^= 1;
    if (change == 3) other.trial ^= 1;
    if (change == 4) other.purpose ^= 1;
    EXPECT_NE(other.block(0), first) << change;
  }
}

TEST(Philox, UniformHasTheMomentsOfOne) {
  const RandomAddress address{.seed = 1, .point = 2, .trial = 3, .purpose = 4};
  const int n = 100000;
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double u = address.uniform(static_cast<std::uint32_t>(i));
    ASSERT_TRUE(u >= 0 && u < 1);
    sum += u;
    squares += u * u;
  }
  EXPECT_NEAR(sum / n, 0.5, 4 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(squares / n, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / n));
}

// First words of xoshiro128++ from state {1, 2, 3, 4}: worked through the published C code by hand.
TEST(Xoshiro, FirstWords) {
  Xoshiro<float> x;
  x.seed(0, {1, 2, 3, 4});
  EXPECT_EQ(x(), 641u);
  EXPECT_EQ(x(), 1573767u);
  EXPECT_EQ(x(), 3222811527u);
}

std::array<std::uint32_t, 4> seed_of(std::uint32_t trial) {
  return RandomAddress{.seed = 11, .point = 0, .trial = trial, .purpose = 1}.block(0);
}

TEST(NormalSource, ALaneIsTheFloatOfThatSeed) {
  NormalSource<Lanes8> eight;
  NormalSource<float> one[8];
  for (int i = 0; i < 8; ++i) {
    eight.seed(i, seed_of(static_cast<std::uint32_t>(i)));
    one[i].seed(0, seed_of(static_cast<std::uint32_t>(i)));
  }
  for (int n = 0; n < 20000; ++n) {
    const auto [x, y] = eight();
    for (int i = 0; i < 8; ++i) {
      const auto [u, v] = one[i]();
      ASSERT_EQ(to_bits(lane(x, i)), to_bits(u));
      ASSERT_EQ(to_bits(lane(y, i)), to_bits(v));
    }
  }
}

TEST(NormalSource, FillIsTheSameAsCallsInTurn) {
  NormalSource<float> called, filled;
  called.seed(0, seed_of(5));
  filled.seed(0, seed_of(5));
  float normals[100];
  for (int round = 0; round < 3; ++round) {
    filled.fill(normals, 100);
    for (int i = 0; i < 100; i += 2) {
      const auto [x, y] = called();
      ASSERT_EQ(normals[i], x);
      ASSERT_EQ(normals[i + 1], y);
    }
  }
}

class NormalSample : public ::testing::Test {
 protected:
  static constexpr int size = 1 << 22;
  static const std::vector<float>& sample() {
    static const std::vector<float> drawn = [] {
      NormalSource<float> source;
      source.seed(0, seed_of(99));
      std::vector<float> all;
      while (all.size() < size) {
        const auto [x, y] = source();
        all.push_back(x);
        all.push_back(y);
      }
      return all;
    }();
    return drawn;
  }
  static double moment(int order) {
    double sum = 0;
    for (float x : sample()) sum += std::pow(static_cast<double>(x), order);
    return sum / size;
  }
};

TEST_F(NormalSample, Moments) {
  const double n = size;
  EXPECT_NEAR(moment(1), 0, 4 / std::sqrt(n));
  EXPECT_NEAR(moment(2), 1, 4 * std::sqrt(2 / n));
  EXPECT_NEAR(moment(3), 0, 4 * std::sqrt(15 / n));
  EXPECT_NEAR(moment(4), 3, 4 * std::sqrt(96 / n));
}

TEST_F(NormalSample, TailsAndQuantiles) {
  for (double level : {-3.0, -1.0, 0.0, 0.5, 2.0, 3.0, 4.0, 4.5}) {
    const double p = 0.5 * std::erfc(level / std::sqrt(2.0));
    const auto above = std::count_if(sample().begin(), sample().end(),
                                     [&](float x) { return static_cast<double>(x) > level; });
    EXPECT_NEAR(static_cast<double>(above), p * size, 4.5 * std::sqrt(size * p * (1 - p))) << level;
  }
}

TEST_F(NormalSample, NeighboursAreUncorrelated) {
  for (std::size_t lag : {1u, 2u, 3u, 17u}) {
    double sum = 0;
    for (std::size_t i = lag; i < sample().size(); ++i)
      sum += static_cast<double>(sample()[i]) * static_cast<double>(sample()[i - lag]);
    EXPECT_NEAR(sum / size, 0, 4.5 / std::sqrt(static_cast<double>(size))) << lag;
  }
}

TEST(SquaredRadius, IsMinusTwiceTheLogarithm) {
  constexpr float whole = 0x1p31f;
  for (int i = 1; i <= 200000; ++i) {
    const float n = std::nearbyint(static_cast<float>(i) / 200000.0f * whole);
    const double exact = -2 * std::log(static_cast<double>(n / whole));
    ASSERT_NEAR(squared_radius(n), exact, 1.5e-7 * (1 + exact));
  }
  EXPECT_GT(squared_radius(1.0f), 42.9f);  // 6.5 sigma
  EXPECT_EQ(squared_radius(whole), 0.0f);
}

}  // namespace
}  // namespace dsp
