// What a sweep of units says of its other axes.
#include "sim/columns/unit_spread_text.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "gtest/gtest.h"

namespace sim {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const Axis range{"receiver.range_m", "m", "", {1, 2, 4}};
const Axis units{unit_key, "1", "", {1, 2, 3, 4, 5}};

/// A result of links whose losses are these, row-major.
Dataset losses_over(std::vector<Axis> axes, std::vector<double> losses) {
  Dataset data;
  data.axes = std::move(axes);
  data.variables.push_back({.facts = {loss_name, "1", ""}, .dimensions = {}, .values = losses});
  return data;
}

// Units 1 to 5 end below 1 m, in 1 .. 2, in 2 .. 4, in 2 .. 4, beyond 4 m.
const Dataset five = losses_over({range, units}, {1, 0, 0, 0, 0,     //
                                                  1, .5, .01, 0, 0,  //
                                                  1, 1, .02, .011, .01});

TEST(UnitSpread, CountsAtEachPointWhoCarries) {
  const auto spread = unit_spread(five);
  ASSERT_TRUE(spread);
  ASSERT_EQ(spread->shares.size(), 3u);
  const std::size_t carried[] = {4, 3, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(spread->shares[i].coordinates, std::vector<double>{range.values[i]});
    EXPECT_EQ(spread->shares[i].units, 5u);
    EXPECT_EQ(spread->shares[i].carried, carried[i]);
  }
}

TEST(UnitSpread, GivesTheRangesOfItsQuantiles) {
  const auto spread = unit_spread(five);
  ASSERT_EQ(spread->rows.size(), 1u);
  const RangeSpread& row = spread->rows[0];
  EXPECT_EQ(row.units, units.values);
  EXPECT_EQ(row.quantiles[0].high, 1);
  EXPECT_TRUE(std::isinf(row.quantiles[0].low));
  EXPECT_EQ(row.quantiles[1].low, 2);
  EXPECT_EQ(row.quantiles[1].high, 4);
  EXPECT_TRUE(std::isinf(row.quantiles[2].high));
}

TEST(UnitSpread, IsSaidInATableAndASentence) {
  EXPECT_EQ(
      unit_spread_lines(five),
      "units drawn within what nobody printed of their part:\n"
      "  receiver           lose at\n"
      "   range_m   units      most\n"
      "       [m]               1 %\n"
      "         1       5         4\n"
      "         2       5         3\n"
      "         4       5         1\n"
      "frame loss passes 1 % at receiver.range_m below 1 m (10 % quantile of 5 units), 2 to 4 m "
      "(median), beyond 4 m (90 % quantile)\n");
}

// More current is better: the range of a unit is then looked for from above.
TEST(UnitSpread, TakesTheGoodEndFromTheLosses) {
  const Axis current{"led.current_ma", "mA", "", {10, 20, 40}};
  const auto spread = unit_spread(losses_over({current, units}, {1, 1, 1, 1, 0,  //
                                                                 1, 1, 1, 0, 0,  //
                                                                 1, 0, 0, 0, 0}));
  const RangeQuantiles& worst_first = spread->rows.at(0).quantiles;
  EXPECT_EQ(worst_first[0].low, 40);
  EXPECT_EQ(worst_first[1].low, 20);
  EXPECT_EQ(worst_first[1].high, 40);
  EXPECT_EQ(worst_first[2].high, 10);
}

// The order in which a sweep lists its values means nothing.
TEST(UnitSpread, TakesValuesInAnyOrder) {
  const Axis mixed{"receiver.range_m", "m", "", {2, 4, 1}};
  const auto spread = unit_spread(losses_over({mixed, units}, {1, .5, .01, 0, 0,      //
                                                               1, 1, .02, .011, .01,  //
                                                               1, 0, 0, 0, 0}));
  const RangeQuantiles& quantiles = spread->rows.at(0).quantiles;
  EXPECT_EQ(quantiles[0].high, 1);
  EXPECT_EQ(quantiles[1].low, 2);
  EXPECT_EQ(quantiles[1].high, 4);
  EXPECT_EQ(quantiles[2].low, 4);
}

// Where as many carry at both ends, the key itself tells which is the good one.
TEST(UnitSpread, KnowsTheGoodEndOfItsKey) {
  const Axis current{"led.current_ma", "mA", "", {10, 20}};
  const auto none = unit_spread(losses_over({current, units}, std::vector<double>(10, 1)));
  EXPECT_EQ(none->rows.at(0).quantiles[1].low, 20);
  const auto all = unit_spread(losses_over({current, units}, std::vector<double>(10, 0)));
  EXPECT_EQ(all->rows.at(0).quantiles[1].high, 10);
}

TEST(UnitSpread, HasARowForEachOfTheOtherAxes) {
  const Axis modules{"receiver.module", "", "", {0, 1}, {"A", "B"}};
  const Axis two{unit_key, "1", "", {1, 2}};
  const Axis near{"receiver.range_m", "m", "", {1, 2}};
  const auto spread = unit_spread(losses_over({modules, two, near}, {0, 1, 0, 0,  //
                                                                     1, 1, 1, 1}));
  ASSERT_EQ(spread->rows.size(), 2u);
  EXPECT_EQ(spread->rows[0].others, std::vector<double>{0});
  EXPECT_EQ(spread->rows[0].quantiles[0].high, 2);
  EXPECT_EQ(spread->rows[1].quantiles[2].high, 1);
}

// A run that was stopped has units without losses: they say nothing.
TEST(UnitSpread, LeavesOutWhatIsNotCounted) {
  const auto spread = unit_spread(losses_over({range, units}, {1, 0, 0, 0, nan,  //
                                                               1, 0, 0, 0, nan,  //
                                                               1, 0, 0, 1, nan}));
  EXPECT_EQ(spread->shares[0].units, 4u);
  EXPECT_EQ(spread->rows.at(0).units, (std::vector<double>{1, 2, 3, 4}));
}

// The part as its file has it is no unit among others.
TEST(UnitSpread, LeavesOutThePartAsAssumed) {
  const Axis and_none{unit_key, "1", "", {0, 1, 2, 3, 4, 5}};
  const auto with = unit_spread(losses_over({range, and_none}, {0, 1, 0, 0, 0, 0,     //
                                                                0, 1, .5, .01, 0, 0,  //
                                                                0, 1, 1, .02, .011, .01}));
  const auto without = unit_spread(five);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(with->shares[i].units, 5u);
    EXPECT_EQ(with->shares[i].carried, without->shares[i].carried);
  }
  EXPECT_EQ(with->rows.at(0).units, units.values);
  const Axis only_one{unit_key, "1", "", {0, 1}};
  EXPECT_FALSE(has_units({only_one}));
}

TEST(UnitSpread, IsNoneOfOneUnitOrWithoutLosses) {
  const Axis one{unit_key, "1", "", {1}};
  EXPECT_FALSE(unit_spread(losses_over({range, one}, {0, 0, 1})));
  EXPECT_FALSE(unit_spread(losses_over({range}, {0, 0, 1})));
  Dataset without = five;
  without.variables.clear();
  EXPECT_FALSE(unit_spread(without));
  EXPECT_EQ(unit_spread_lines(without), "");
}

}  // namespace
}  // namespace sim
