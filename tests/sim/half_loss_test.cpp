// Where half the frames are lost, of links whose loss jumps at a known value.
#include "sim/page/half_loss.hpp"

#include <gtest/gtest.h>

namespace sim {
namespace {

using Kind = HalfLoss::Kind;

HalfLoss search(const LosesHalf& loses_half, double begin, const Range& allowed,
                bool more_is_better) {
  return find_half_loss(loses_half, {.begin = begin,
                                     .begin_loses = loses_half(begin).value(),
                                     .allowed = allowed,
                                     .more_is_better = more_is_better});
}

TEST(HalfLoss, IsFoundOnEitherSideOfWhereItIsLookedFor) {
  for (const double jump : {0.3, 2.17, 2.9, 21.0}) {
    const auto beyond = [&](double x) { return x >= jump; };
    const HalfLoss half = search(beyond, 2.2, from(0.01, 1000), false);
    EXPECT_EQ(half.kind, Kind::between);
    EXPECT_NEAR(half.at, jump, 0.012 * jump);
  }
}

TEST(HalfLoss, IsBelowWhereMoreIsBetter) {
  const auto below = [](double x) { return x <= 40; };
  for (const double begin : {3.0, 40.0, 500.0}) {
    const HalfLoss half = search(below, begin, from(1, 1000), true);
    EXPECT_EQ(half.kind, Kind::between);
    EXPECT_NEAR(half.at, 40, 0.5) << begin;
  }
}

TEST(HalfLoss, IsLookedForNoFartherThanTheKeyAllows) {
  const auto never = [](double) { return false; };
  const auto always = [](double) { return true; };
  EXPECT_EQ(search(never, 2, from(1, 5), false).kind, Kind::not_yet);
  EXPECT_EQ(search(never, 2, from(1, 5), false).at, 5);
  EXPECT_EQ(search(never, 2, from(1, 1e6), false).at, 128) << "64 times as far";
  EXPECT_EQ(search(always, 2, from(1, 5), false).kind, Kind::already);
  EXPECT_EQ(search(always, 2, from(1, 5), false).at, 1);
  EXPECT_EQ(search(always, 2, above(0, 5), false).at, 2.0 / 64) << "0 has no logarithm";
}

TEST(HalfLoss, IsLookedForNoFartherThanCanBeSimulated) {
  const auto short_of_nine = [](double x) {
    return x < 9 ? std::optional<bool>(false) : std::nullopt;
  };
  const HalfLoss half = search(short_of_nine, 2, from(1, 1000), false);
  EXPECT_EQ(half.kind, Kind::not_yet);
  EXPECT_EQ(half.at, 8);
}

TEST(HalfLoss, AsksElevenTimes) {
  int asked = 0;
  const auto beyond = [&](double x) { return ++asked, x >= 120; };
  find_half_loss(beyond, {.begin = 2, .begin_loses = false, .allowed = from(0.01, 1000)});
  EXPECT_EQ(asked, 11);
}

}  // namespace
}  // namespace sim
