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

}  // namespace
}  // namespace sim
