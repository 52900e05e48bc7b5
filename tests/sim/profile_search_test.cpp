#include "sim/fit/profile_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "sim/fit/first_search.hpp"

namespace sim {
namespace {

/// Of two numbers the sum is known well, and whether the first one is 2 or more. Before, they are
/// thought to be near 0 and 3.
LeastSquaresProblem sum_and_jump() {
  return {[](const Numbers& x, const std::function<bool(double)>& take) {
            if (take((x[0] + x[1] - 3) / 0.1)) take(x[0] < 2 ? 20 : 0);
          },
          {{.middle = 0, .deviation = 1}, {.middle = 3, .deviation = 1}},
          {true, true}};
}

const std::vector<bool> both{true, true};

// The jump is worth 6.25 ln(1 + 20^2 / 6.25) = 26 (least_squares.cpp), the way to it 2^2 + 2^2.
TEST(ProfileSearch, FindsWhatIsBehindAJump) {
  const LeastSquaresProblem problem = sum_and_jump();
  EXPECT_LT(least_squares(problem, {0, 3}, 20).x[0], 1);
  const Numbers found = profile_search(problem, {0, 3}, both, [] { return true; });
  EXPECT_GE(found[0], 2);
  EXPECT_LT(found[0], 2.6);
  EXPECT_NEAR(found[0] + found[1], 3, 0.1);
}

TEST(ProfileSearch, StaysWhereAJumpIsNotWorthTheWay) {
  LeastSquaresProblem problem = sum_and_jump();
  for (ParameterPrior& prior : problem.priors) prior.deviation = 0.5;  // the way is 32
  EXPECT_LT(profile_search(problem, {0, 3}, both, [] { return true; })[0], 1);
}

TEST(ProfileSearch, MovesNothingWithoutTime) {
  EXPECT_EQ(profile_search(sum_and_jump(), {0, 3}, both, [] { return false; }), (Numbers{0, 3}));
}

TEST(ProfileSearch, MovesOnlyWhatItIsTold) {
  const Numbers start{0, 3};
  EXPECT_EQ(profile_search(sum_and_jump(), start, {false, false}, [] { return true; }), start);
}

// The second number's way leads nowhere, and what is fitted from there is dearer.
TEST(ProfileSearch, KeepsTheBestOfAllWays) {
  const LeastSquaresProblem problem{
      [](const Numbers& x, const std::function<bool(double)>& take) { take(x[0] < 2 ? 20 : 0); },
      {{.middle = 0, .deviation = 1}, {.middle = 0, .deviation = 1}},
      {true, true}};
  EXPECT_GE(profile_search(problem, {0, 0}, both, [] { return true; })[0], 2);
}

/// The first number is that of a constant, the other two are levels: bursts at the second one are
/// reported where it is 0.8 dB stronger than the plan says.
TEST(FirstSearch, TriesEachLevel) {
  const LeastSquaresProblem problem{[](const Numbers& x, const std::function<bool(double)>& take) {
                                      if (take(x[1])) take(x[2] < 0.8 ? 30 : 0);
                                    },
                                    {{.middle = 0, .deviation = 1},
                                     {.middle = 0, .deviation = 0.6},
                                     {.middle = 0, .deviation = 0.6}},
                                    {true, true, true}};
  EXPECT_EQ(best_of_each_level(problem, {5, 0, 0}, 1), (Numbers{5, 0, 1}));
}

TEST(FirstSearch, LeavesALevelThatIsBetterThanThoseItTries) {
  const LeastSquaresProblem problem{
      [](const Numbers& x, const std::function<bool(double)>& take) { take((x[0] - 0.8) / 0.01); },
      {{.middle = 0, .deviation = 0.6}},
      {true}};
  EXPECT_EQ(best_of_each_level(problem, {0.8}, 0), (Numbers{0.8}));
}

TEST(FirstSearch, LeavesLevelsThatAreNotFree) {
  const LeastSquaresProblem problem{
      [](const Numbers& x, const std::function<bool(double)>& take) { take(x[0] < 0.8 ? 30 : 0); },
      {{.middle = 0, .deviation = 0.6}},
      {false}};
  EXPECT_EQ(best_of_each_level(problem, {0}, 0), (Numbers{0}));
}

}  // namespace
}  // namespace sim
