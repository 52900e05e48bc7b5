// What keys of a scenario are set to, in words, for those who compare results.
#include "sim/scenario/settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/loading/load_scenario.hpp"

namespace sim {
namespace {

std::string setting(const std::vector<Setting>& settings, const std::string& key) {
  EXPECT_EQ(std::ranges::count(settings, key, &Setting::key), 1) << key;
  return std::ranges::find(settings, key, &Setting::key)->value;
}

TEST(Settings, AreThoseOfTheScenarioWithTheirUnits) {
  const std::vector<Setting> settings = settings_of(parse_scenario(
      "title = \"a title\"\nreceiver.module = \"TSOP4856\"\nled.current_ma = 50\n"
      "device.message = \"IND 1\"\n[disturbance.lamp]\nkind = \"fluorescent\"\nballast_hz = 4e4\n",
      "x.toml", {"simulation.seed=7"}, {COSYS_SOURCE_DIR "/scenarios"}));
  for (const auto& [key, value] : {std::pair{"title", "a title"},
                                   {"receiver.module", "TSOP4856"},
                                   {"led.current_ma", "50 mA"},
                                   {"simulation.seed", "7"},
                                   {"disturbance.lamp.kind", "fluorescent"},
                                   {"disturbance.lamp.ballast_hz", "40000 Hz"}})
    EXPECT_EQ(setting(settings, key), value) << key;
}

TEST(Settings, OfASweptKeyAreItsValues) {
  const std::vector<Setting> settings =
      settings_of(parse_scenario("[sweep]\nreceiver.module = [\"TSOP4856\", \"TSOP4156\"]\n"
                                 "receiver.range_m = \"1:1:20\"\nled.current_ma = [50, 100]\n",
                                 "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"}));
  EXPECT_EQ(setting(settings, "receiver.module"), "TSOP4856, TSOP4156");
  EXPECT_EQ(setting(settings, "receiver.range_m"), "1 .. 20 m (20 values)");
  EXPECT_EQ(setting(settings, "led.current_ma"), "50, 100 mA");
}

TEST(Settings, OfPartsAreTheirNames) {
  const std::vector<Setting> settings =
      settings_of(parse_scenario("[module]\nq = 8\n[sweep]\n"
                                 "receiver.module = [\"TSOP4856\", \"TSOP4156\"]\n",
                                 "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"}));
  EXPECT_EQ(setting(settings, "module.centre_hz"), "by receiver.module");
  EXPECT_EQ(setting(settings, "module.q"), "8") << "which the scenario says";
  EXPECT_EQ(setting(settings, "floor.diffuse_reflectance"), "by floor.part");
}

}  // namespace
}  // namespace sim
