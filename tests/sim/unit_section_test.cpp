// Which of what nobody printed moves the range.
#include "sim/page/unit_section.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "scenarios.hpp"

namespace sim {
namespace {

const LoadedScenario& sixteen() {
  static const LoadedScenario scenario =
      loaded("", {"receiver.unit=1:1:16", "receiver.range_m=1:1:40"});
  return scenario;
}

/// Units whose range falls with their attack alone.
UnitSpread ruled_by_the_attack() {
  std::vector<double> losses;
  for (const double unit : sixteen().sweep[0].values)
    for (const double range : sixteen().sweep[1].values) {
      const double attack = point_scenario(sixteen(), {unit, range}).module.agc_attack_db_per_ms;
      losses.push_back(range < 2 / attack ? 0 : 1);
    }
  return *unit_spread(sixteen().sweep, losses);
}

TEST(NumberEffects, TheNumberThatRulesTheRangeComesFirst) {
  const auto effects = number_effects(sixteen(), ruled_by_the_attack());
  ASSERT_FALSE(effects.empty());
  EXPECT_EQ(effects[0].key, "module.agc_attack_db_per_ms");
  EXPECT_LT(effects[0].correlation, -0.97);
  EXPECT_GT(effects[0].range_at_low, effects[0].range_at_high);
  EXPECT_LT(effects[0].low, effects[0].high);
  // By chance one in twenty looks as if it had an effect.
  EXPECT_LT(effects.size(), 5U);
}

TEST(NumberEffects, NothingIsSaidOfARangeThatDoesNotMove) {
  const std::vector<double> none(16 * 40, 0.0);
  EXPECT_TRUE(number_effects(sixteen(), *unit_spread(sixteen().sweep, none)).empty());
}

TEST(UnitsOnAPage, HaveATableAndABarForEachNumber) {
  const UnitSpread spread = ruled_by_the_attack();
  const PageSection units = units_section(spread);
  EXPECT_EQ(units.table->head,
            (std::vector<std::string>{"receiver.range_m [m]", "units", "lose at most 1 %"}));
  EXPECT_EQ(units.table->rows[0][2], "100 % [79, 100]");
  const auto effects = number_effects(sixteen(), spread);
  const PageSection moved = effects_section(spread, effects);
  EXPECT_EQ(moved.table->rows.size(), effects.size());
  EXPECT_EQ(moved.table->rows[0][0], "module.agc_attack_db_per_ms");
  EXPECT_NE(moved.picture->svg.find(">module.agc_attack_db_per_ms<"), std::string::npos);
}

/// Two modules, along a range from 1 to 40 m.
UnitSpread two_modules() {
  UnitSpread spread;
  spread.axes = {{"receiver.module", "", "", {0, 1}, {"A", "B"}},
                 {"receiver.range_m", "m", "", {1, 10, 40}}};
  spread.abscissa = 1;
  spread.rows = {{{1}, {1, 2}, {{1, 10}, {10, 40}}, {}}, {{0}, {1, 2}, {{1, 10}, {10, 40}}, {}}};
  return spread;
}

// What ends at an end of the sweep may go on.
TEST(UnitsOnAPage, SayWhereARangeIsThatOfTheSweep) {
  const NumberEffect effect{.key = "module.q", .unit = "1", .range_at_low = 40, .range_at_high = 1};
  const PageSection section = effects_section(two_modules(), {effect});
  EXPECT_EQ(section.table->rows[0][2], ">= 40");
  EXPECT_EQ(section.table->rows[0][4], "<= 1");
}

TEST(UnitsOnAPage, NameTheRowThatTheTornadoIsOf) {
  const NumberEffect effect{.key = "module.q", .unit = "", .range_at_low = 20, .range_at_high = 3};
  UnitSpread spread = two_modules();
  EXPECT_TRUE(effects_section(spread, {effect})
                  .text.starts_with("At receiver.module = B, the first of the sweep. The strong"));
  spread.rows.pop_back();
  EXPECT_TRUE(effects_section(spread, {effect}).text.starts_with("At receiver.module = B. The"));
  spread.axes.erase(spread.axes.begin());
  spread.abscissa = 0;
  spread.rows[0].others.clear();
  EXPECT_TRUE(effects_section(spread, {effect}).text.starts_with("The strongest"));
}

}  // namespace
}  // namespace sim
