#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "sim/fit/global_search.hpp"
#include "sim/fit/grid_search.hpp"
#include "sim/fit/least_squares.hpp"

namespace {

using sim::LeastSquaresProblem;
using sim::Numbers;

constexpr std::size_t n_deviations = 100;

/// Two numbers, each of which half of the deviations are about. `looked_at` counts them.
LeastSquaresProblem squares(std::size_t& looked_at) {
  return {[&looked_at](const Numbers& x, const std::function<bool(double)>& take) {
            for (std::size_t i = 0; i < n_deviations; ++i) {
              ++looked_at;
              if (!take(x[i % 2] - static_cast<double>(i % 2))) return;
            }
          },
          {{.middle = 0, .deviation = 10}, {.middle = 0, .deviation = 10}},
          {true, true}};
}

TEST(Cost, IsLookedIntoNoFurtherThanTheMost) {
  std::size_t looked_at = 0;
  const LeastSquaresProblem problem = squares(looked_at);
  const double whole = cost_of(problem, {1, 2});
  EXPECT_EQ(looked_at, n_deviations);
  EXPECT_EQ(cost_of(problem, {1, 2}, whole), whole);
  EXPECT_EQ(looked_at, 2 * n_deviations);
  EXPECT_GT(cost_of(problem, {1, 2}, whole / 4), whole / 4);
  EXPECT_LE(looked_at, 2 * n_deviations + n_deviations / 3);
}

TEST(Cost, OfGridsIsKnownOfTheBestAlone) {
  std::size_t looked_at = 0;
  const LeastSquaresProblem problem = squares(looked_at);
  const std::vector<double> values = sim::steps_between(0, 4, 9);
  const auto best = sim::best_of_grid(problem, {0, 0}, {{0, values}, {1, values}}, 2);
  ASSERT_EQ(best.size(), 2U);
  EXPECT_EQ(best[0].x, (Numbers{0, 1}));
  EXPECT_EQ(best[1].x, (Numbers{0, 0.5}));  // the prior prefers it to {0, 1.5}
  EXPECT_EQ(best[1].cost, cost_of(problem, best[1].x));
  EXPECT_LT(looked_at, 81 * n_deviations / 2);
}

TEST(Cost, OfASearchIsThatOfOneThatLooksAtAll) {
  std::size_t short_ways = 0, whole_ways = 0;
  const LeastSquaresProblem problem = squares(short_ways);
  LeastSquaresProblem all = squares(whole_ways);
  all.visit_deviations = [whole = all.visit_deviations](const Numbers& x, const auto& take) {
    whole(x, [&](double deviation) {
      take(deviation);
      return true;
    });
  };
  const std::vector<sim::SearchedNumber> anywhere{{0, -9, 9}, {1, -9, 9}};
  const Numbers found = global_search(problem, {5, 5}, anywhere, 300, 1);
  EXPECT_EQ(found, global_search(all, {5, 5}, anywhere, 300, 1));
  EXPECT_NEAR(found[1], 1, 0.1);
  EXPECT_LT(short_ways, whole_ways);
}

}  // namespace
