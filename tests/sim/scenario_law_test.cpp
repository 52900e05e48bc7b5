// What holds for every key of a scenario, and what a loaded scenario keeps of its text.
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/failure.hpp"
#include "sim/location/location_keys.hpp"  // the kinds that some scenarios are of
#include "sim/scenario/canonical_text.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

/// A value that a number may have besides its default, close enough not to contradict other keys.
double other_value(const Key& key) {
  Scenario defaults;
  const double standard = key.number(defaults);
  if (std::isnan(standard)) return key.facts.range.high / 2;  // unset by default
  if (key.name() == "device.pulse_us") return 200;            // 0: none; no shorter than 4 periods
  if (key.facts.type == KeyType::flag) return 1 - standard;
  if (key.facts.type == KeyType::whole_number) return standard + 1;
  const double up = standard == 0 ? 1.0 / 64 : standard * 1.0078125;
  return key.facts.range.contains(up) ? up : standard * 0.984375;
}

std::string other_text(const Key& key) {
  if (key.name() == "led.part") return "tsal6200";
  if (key.name() == "receiver.module") return "tsop4856";
  if (key.name() == "floor.part") return "INDOOR";
  if (key.name().ends_with(".photodiode")) return "bpw34";
  if (key.facts.type == KeyType::number_list)
    return fmt::format("{},{}", key.facts.range.high / 2, key.facts.range.high / 4);
  return key.facts.type == KeyType::choice ? key.choices.back() : "RFID \"S:\\U";
}

std::string in_toml(const Key& key, const std::string& value) {
  return key.is_number() ? key.name() + " = " + value + "\n" : key.name() + " = '" + value + "'\n";
}

std::string other(const Key& key) {
  return key.is_number() ? fmt::format("{}", other_value(key)) : other_text(key);
}

/// What other keys must be for this one to have its other value.
std::vector<std::string> companions(const Key& key) {
  if (key.name() == "simulation.fidelity") return {"receiver.module=ideal-coherent"};
  return {};
}

TEST(ScenarioLaw, EveryKeyIsSetByFileAndBySetAlike) {
  for (const Key& key : scenario_keys()) {
    std::vector<std::string> overrides = companions(key);
    LoadedScenario file = loaded(in_toml(key, other(key)), overrides);
    overrides.push_back(key.name() + "=" + other(key));
    LoadedScenario set = loaded("", overrides);
    if (key.is_number()) {
      EXPECT_EQ(key.number(file.base), other_value(key)) << key.name();
      EXPECT_EQ(key.number(set.base), other_value(key)) << key.name();
    } else {
      EXPECT_EQ(key.text(file.base), other_text(key)) << key.name();
      EXPECT_EQ(key.text(set.base), other_text(key)) << key.name();
    }
    EXPECT_EQ(canonical_text(file.base), canonical_text(set.base)) << key.name();
    EXPECT_EQ(file.places.at(key.name()), "in x.toml:1");
    EXPECT_EQ(set.places.at(key.name()), "in --set");
  }
}

TEST(ScenarioLaw, EveryNumberSweepsAndOnlyItChanges) {
  for (const Key& key : scenario_keys()) {
    if (!key.is_number()) continue;
    Scenario defaults;
    const double standard = key.number(defaults);
    const std::string values = fmt::format(
        "{},{}", std::isnan(standard) ? key.facts.range.high : standard, other_value(key));
    const auto swept = loaded("[sweep]\n\"" + key.name() + "\" = \"" + values + "\"\n");
    ASSERT_EQ(swept.sweep.size(), 1U) << key.name();
    EXPECT_EQ(swept.sweep[0].unit, key.facts.unit);
    EXPECT_EQ(swept.sweep[0].long_name, key.facts.long_name);
    const auto fixed = loaded("", {key.name() + "=" + other(key)});
    Scenario point = point_scenario(swept, {other_value(key)});
    EXPECT_EQ(key.number(point), other_value(key));
    EXPECT_EQ(canonical_text(point), canonical_text(fixed.base)) << key.name();
    EXPECT_EQ(loaded("", {key.name() + "=" + values}).sweep[0].values, swept.sweep[0].values);
  }
}

TEST(ScenarioLaw, AnEmptyFileIsTheStructsDefaults) {
  Scenario empty = loaded("").base, defaults;
  for (const Key& key : scenario_keys()) {
    if (!key.is_number()) {
      EXPECT_EQ(key.text(empty), key.text(defaults)) << key.name();
    } else if (part_giving(key.name()).empty() && !std::isnan(key.number(defaults))) {
      EXPECT_EQ(key.number(empty), key.number(defaults)) << key.name();
    }
  }
  EXPECT_TRUE(std::isnan(empty.receiver.ebn0_db)) << "unset";
}

TEST(ScenarioLaw, CanonicalTextTellsPhysicsAndNothingElse) {
  for (const Key& key : scenario_keys()) {
    const std::string standard = canonical_text(loaded("", companions(key)).base);
    const auto changed = canonical_text(loaded(in_toml(key, other(key)), companions(key)).base);
    EXPECT_EQ(changed != standard, key.physics) << key.name();
  }
}

TEST(ScenarioLaw, WhatIsCountedHowOftenIsNoPhysics) {
  std::string names;
  for (const Key& key : scenario_keys())
    if (!key.physics) names += key.name() + " ";
  EXPECT_EQ(
      names,
      "title led.part receiver.module floor.part simulation.seed stop.max_frames "
      "stop.max_frame_errors stop.rel_ci stop.target_flr arena.runs guard.line_baud "
      "guard.byte_error_ratio guard.outage_every_s guard.outage_for_s guard.transmit_every_ms "
      "guard.full_set_every_s guard.compressed guard.query_age_s guard.query_timeout_s "
      "exchange.runs "
      "presence.trials presence.photodiode location.photodiode location.trials listening.runs ");
}

TEST(ScenarioLaw, CanonicalTextTellsTheCurvesOfTheParts) {
  const Scenario base = loaded("").base;
  for (int curve = 0; curve < 3; ++curve) {
    Scenario s = base;
    auto& changed = curve == 0   ? s.module.directivity
                    : curve == 1 ? s.emitter.intensity_mw_per_sr
                                 : s.emitter.pattern;
    changed.y[1] = std::nextafter(changed.y[1], 2);
    EXPECT_NE(canonical_text(s), canonical_text(base)) << curve;
  }
}

TEST(ScenarioLaw, CanonicalTextTellsTheLastBitOfANumber) {
  for (const Key& key : scenario_keys()) {
    if (!key.is_number() || !key.physics) continue;
    Scenario s = loaded("").base;
    if (std::isnan(key.number(s))) key.number(s) = 10;
    const std::string before = canonical_text(s);
    key.number(s) = std::nextafter(key.number(s), 1e300);
    EXPECT_NE(canonical_text(s), before) << key.name();
  }
}

TEST(ScenarioLaw, CanonicalTextDoesNotDependOnThePlaceInASweep) {
  const auto a = loaded("[sweep]\nreceiver.range_m = \"0.1:0.1:0.5\"\nled.yaw_deg = [-0.0, 5]");
  const auto b = loaded("[sweep]\nled.yaw_deg = \"5:-5:0\"\nreceiver.range_m = [7, 0.3]");
  EXPECT_EQ(canonical_text(point_scenario(a, point_coordinates(a.sweep, 4))),
            canonical_text(point_scenario(b, point_coordinates(b.sweep, 3))));
}

TEST(ScenarioLaw, TheKeptTextRepeatsTheRun) {
  const std::string text = "title = \"a\"\n[sweep]\nreceiver.range_m = [1, 2]\n[led]\nyaw_deg = 3";
  const std::vector<std::string> overrides{"title=q\"u\\o\tt=e", "led.yaw_deg=4,5",
                                           "device.message=x \"\\ y", "receiver.range_m=3",
                                           "receiver.range_m=3:1:5"};
  for (std::size_t n = 0; n <= overrides.size(); ++n) {
    std::vector<std::string> some(overrides.begin(), overrides.begin() + static_cast<long>(n));
    if (n > 0) some[0] = "title=q\"u\\o = \xc3\xa4";
    const auto first = loaded(text, some);
    const auto again = loaded(first.text);
    EXPECT_EQ(again.base.title, first.base.title);
    EXPECT_EQ(canonical_text(again.base), canonical_text(first.base));
    ASSERT_EQ(again.sweep.size(), first.sweep.size());
    for (std::size_t i = 0; i < first.sweep.size(); ++i) {
      EXPECT_EQ(again.sweep[i].key, first.sweep[i].key);
      EXPECT_EQ(again.sweep[i].values, first.sweep[i].values);
    }
  }
}

TEST(Scenario, ModuleKeysOverrideTheirPart) {
  const auto s = loaded("[module]\nq = 7\n[receiver]\nmodule = \"tsop4856\"").base;
  EXPECT_EQ(s.module.q, 7);
  EXPECT_EQ(s.module.centre_hz, 56000);
  EXPECT_FALSE(s.module.directivity.empty());
  EXPECT_EQ(s.emitter.name, "TSAL6200");
}

TEST(Scenario, SweepKeepsTheOrderOfTheFileAndSetActsOnIt) {
  const std::string text =
      "[sweep]\nreceiver.range_m = \"1:1:3\"\nreceiver.bearing_deg = 5\n"
      "'led.current_ma' = [10, 20]\ndevice.baud = \"300\"\n";
  const auto keys = [](const LoadedScenario& scenario) {
    std::string names;
    for (const auto& axis : scenario.sweep)
      names += fmt::format("{}:{} ", axis.key, axis.values.size());
    return names;
  };
  EXPECT_EQ(keys(loaded(text)),
            "receiver.range_m:3 receiver.bearing_deg:1 led.current_ma:2 device.baud:1 ");
  EXPECT_EQ(keys(loaded(text, {"receiver.bearing_deg=0", "led.current_ma=1,2,3"})),
            "receiver.range_m:3 led.current_ma:3 device.baud:1 ");
  const auto one = loaded(text, {"receiver.range_m=9", "floor.roughness_um=0:1:3"});
  EXPECT_EQ(keys(one),
            "receiver.bearing_deg:1 led.current_ma:2 device.baud:1 floor.roughness_um:4 ");
  EXPECT_EQ(one.base.receiver.range_m, 9);
}

std::string mutated(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  for (std::size_t n = 1 + below(4); n-- > 0;) {
    const std::size_t at = below(text.size());
    switch (below(4)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, 1 + below(10));
        break;
      case 2:
        text.insert(at, text.substr(below(text.size()), below(30)));
        break;
      default:
        text.insert(at, 1, "[]{}\"'=.,:#-0e\n"[below(15)]);
    }
  }
  return text;
}

TEST(ScenarioLaw, GarbageIsRefusedOrRunButNeverCrashes) {
  const std::string good =
      read_text_file(COSYS_SOURCE_DIR "/scenarios/quickstart.toml", "scenario");
  std::mt19937 random(3);
  int refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const std::string text = mutated(good, random);
    try {
      loaded(text);
    } catch (const Failure& failure) {
      ++refused;
      EXPECT_EQ(failure.code(), ExitCode::bad_input);
      EXPECT_EQ(std::string(failure.what()).find('\n'), std::string::npos) << text;
    }
  }
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace sim
