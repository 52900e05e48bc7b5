// Drawn units: what nobody printed of a part, within its bounds.
#include "sim/components/drawn_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <variant>
#include <vector>

#include "channel/conditions.hpp"
#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/components/parts.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/location/location_keys.hpp"  // the kinds that some scenarios are of
#include "sim/scenario/canonical_text.hpp"
#include "sim/scenario/entries.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

using channel::Distribution;
using channel::NumberBounds;

channel::ModuleData tsop4856() {
  return load_module("TSOP4856", {{COSYS_SOURCE_DIR "/scenarios"}, {}, {}}, "").data;
}

const NumberBounds* bounds_of(const channel::ModuleData& module, const std::string& number) {
  const auto at = std::ranges::find(module.bounds, number, &NumberBounds::number);
  return at == module.bounds.end() ? nullptr : &*at;
}

/// The only point of a scenario.
Scenario only_point(const std::vector<std::string>& set) {
  return point_scenario(loaded("", set), {});
}

double attack_of(const std::vector<std::string>& set) {
  return only_point(set).module.agc_attack_db_per_ms;
}

/// Of a sample from what should be uniform on [0, 1): Kolmogorov and Smirnov's distance.
double distance_from_uniform(std::vector<double> sample) {
  std::ranges::sort(sample);
  const auto n = static_cast<double>(sample.size());
  double distance = 0;
  for (std::size_t i = 0; i < sample.size(); ++i)
    distance = std::max({distance, std::abs(sample[i] - static_cast<double>(i) / n),
                         std::abs(sample[i] - static_cast<double>(i + 1) / n)});
  return distance;
}

TEST(NumberBounds, QuantilesAreThoseOfTheDistribution) {
  const NumberBounds even{"x", 2, 8}, log{"x", 0.05, 0.45, Distribution::log_uniform};
  EXPECT_EQ(quantile(even, 0), 2);
  EXPECT_EQ(quantile(even, 0.5), 5);
  EXPECT_NEAR(quantile(log, 0.5), 0.15, 1e-12);
  EXPECT_NEAR(quantile(log, 1), 0.45, 1e-12);
}

TEST(DrawnPart, NumbersAreDistributedAsTheFileSays) {
  const channel::ModuleData part = tsop4856();
  ASSERT_FALSE(part.bounds.empty());
  constexpr int n = 4000;
  std::vector<double> log_attack, margin;
  for (std::uint32_t unit = 1; unit <= n; ++unit) {
    const auto drawn = with_drawn_numbers(part, {.seed = 1, .trial = unit});
    for (const NumberBounds& b : part.bounds) {
      const auto& numbers = module_keys().numbers;
      const auto number =
          std::ranges::find(numbers, b.number, [](const auto& k) { return k.facts.name; });
      ASSERT_GE(drawn.*number->member, b.low) << b.number;
      ASSERT_LE(drawn.*number->member, b.high) << b.number;
    }
    const NumberBounds& attack = *bounds_of(part, "agc_attack_db_per_ms");
    log_attack.push_back(std::log(drawn.agc_attack_db_per_ms / attack.low) /
                         std::log(attack.high / attack.low));
    const NumberBounds& m = *bounds_of(part, "agc_margin_db");
    margin.push_back((drawn.agc_margin_db - m.low) / (m.high - m.low));
  }
  const double critical = 1.95 / std::sqrt(n);  // of the distance, at 0.1 %
  EXPECT_LT(distance_from_uniform(log_attack), critical);
  EXPECT_LT(distance_from_uniform(margin), critical);
}

// A file that learns one number more must not move the units' others.
TEST(DrawnPart, ANumbersDrawDependsOnNoOther) {
  channel::ModuleData part = tsop4856();
  const auto before = with_drawn_numbers(part, {.seed = 7, .trial = 3});
  std::erase_if(part.bounds, [](const NumberBounds& b) { return b.number == "agc_margin_db"; });
  const auto after = with_drawn_numbers(part, {.seed = 7, .trial = 3});
  EXPECT_EQ(after.agc_attack_db_per_ms, before.agc_attack_db_per_ms);
  EXPECT_EQ(after.agc_margin_db, part.agc_margin_db);
  EXPECT_NE(before.agc_margin_db, part.agc_margin_db);
}

// Both may have bounds, which overlap.
TEST(DrawnPart, TheGreatestThresholdIsNeverBelowTheDrawnOne) {
  channel::ModuleData part = tsop4856();
  part.bounds = {{"emin_mw_per_m2", 0.1, 0.3}, {"emin_max_mw_per_m2", 0.2, 0.25}};
  int raised = 0;
  for (std::uint32_t unit = 1; unit <= 100; ++unit) {
    const auto drawn = with_drawn_numbers(part, {.seed = 1, .trial = unit});
    EXPECT_GE(drawn.emin_max_mw_per_m2, drawn.emin_mw_per_m2);
    if (drawn.emin_max_mw_per_m2 > 0.25) ++raised;
  }
  EXPECT_GT(raised, 10);
  part.emin_max_mw_per_m2 = 0;  // the sheet does not say
  std::erase_if(part.bounds, [](const auto& b) { return b.number == "emin_max_mw_per_m2"; });
  EXPECT_EQ(with_drawn_numbers(part, {.seed = 1, .trial = 1}).emin_max_mw_per_m2, 0);
}

TEST(ReceiverUnit, IsTheSameUnitAtEveryPointAndAnotherByItsNumber) {
  EXPECT_EQ(attack_of({}), tsop4856().agc_attack_db_per_ms);
  const double third = attack_of({"receiver.unit=3"});
  EXPECT_NE(third, tsop4856().agc_attack_db_per_ms);
  EXPECT_EQ(attack_of({"receiver.unit=3", "receiver.range_m=7"}), third);
  EXPECT_NE(attack_of({"receiver.unit=4"}), third);
  EXPECT_NE(attack_of({"receiver.unit=3", "simulation.seed=2"}), third);
}

TEST(ReceiverUnit, HasACentreAndAThresholdOfItsOwn) {
  const Scenario unit = only_point({"receiver.unit=3"});
  EXPECT_NE(unit.module.centre_hz, 56e3);
  EXPECT_GE(unit.module.emin_mw_per_m2, 0.12);
  EXPECT_LE(unit.module.emin_mw_per_m2, 0.25);
  EXPECT_NE(unit.floor.roughness_um, only_point({}).floor.roughness_um);
}

TEST(ReceiverUnit, KeepsWhatTheScenarioGives) {
  const std::vector<std::string> given{"receiver.unit=3", "module.agc_attack_db_per_ms=0.2"};
  EXPECT_EQ(attack_of(given), 0.2);
  EXPECT_EQ(only_point(given).module.agc_margin_db,
            only_point({"receiver.unit=3"}).module.agc_margin_db);
  const LoadedScenario swept = loaded("", {"receiver.unit=3", "module.agc_range_db=60,70"});
  EXPECT_EQ(point_scenario(swept, {70}).module.agc_range_db, 70);
}

// Which unit a point has depends on no other point of the sweep.
TEST(ReceiverUnit, CanBeSwept) {
  const LoadedScenario swept = loaded("", {"receiver.unit=0,3,4", "receiver.range_m=1,2"});
  EXPECT_EQ(point_scenario(swept, {3, 2}).module.agc_attack_db_per_ms,
            attack_of({"receiver.unit=3"}));
  EXPECT_EQ(point_scenario(swept, {0, 2}).module.agc_attack_db_per_ms, attack_of({}));
  EXPECT_EQ(canonical_text(point_scenario(swept, {0, 1})), canonical_text(only_point({})));
}

TEST(ReceiverUnit, IsThatOfItsPointsSeed) {
  const LoadedScenario seeds = loaded("", {"receiver.unit=3", "simulation.seed=1,2"});
  EXPECT_EQ(point_scenario(seeds, {2}).module.agc_attack_db_per_ms,
            attack_of({"receiver.unit=3", "simulation.seed=2"}));
}

TEST(ReceiverUnit, NamesEachDrawnNumberOnce) {
  const auto numbers = drawn_numbers(only_point({"receiver.unit=3", "receiver.module=TSSP4056"}));
  for (const DrawnNumber& number : numbers)
    EXPECT_EQ(std::ranges::count(numbers, number.key, &DrawnNumber::key), 1) << number.key;
}

TEST(ReceiverUnit, HasLedsOfDevicesToo) {
  const auto arena = [](const std::vector<std::string>& set) {
    return only_point(with_keys({"experiment=arena", "devices.a.x_m=1", "devices.a.led=generic",
                                 "devices.b.x_m=2", "devices.b.led=generic", "devices.c.x_m=3"},
                                set));
  };
  const double as_assumed = arena({}).devices.at("a").emitter.half_angle_deg;
  const Scenario unit = arena({"receiver.unit=3"});
  EXPECT_NE(unit.devices.at("a").emitter.half_angle_deg, as_assumed);
  EXPECT_EQ(unit.devices.at("a").emitter.half_angle_deg,
            unit.devices.at("b").emitter.half_angle_deg);
  const auto numbers = drawn_numbers(unit);
  EXPECT_EQ(std::ranges::count(numbers, "devices.a.led.half_angle_deg", &DrawnNumber::key), 1);
  EXPECT_EQ(std::ranges::count(numbers, "devices.c.led.half_angle_deg", &DrawnNumber::key), 0);
}

TEST(ReceiverUnit, IsRefusedWhereNoNumberOfItsPartsHasBounds) {
  const std::vector<std::string> presence{"experiment=presence", "receiver.unit=3"};
  EXPECT_EQ(refusal("", with_keys(presence, {"floor.part=none"})),
            "receiver.unit = 3 in --set (all numbers of its LED and floor are known, so all units "
            "are alike) use parts with bounds, or no unit");
  EXPECT_EQ(refusal("", with_keys(presence, {"floor.part=none", "led.part=generic"})), "accepted");
  EXPECT_EQ(refusal("", presence), "accepted");
}

TEST(ReceiverUnit, IsRefusedBesideAPopulation) {
  EXPECT_EQ(refusal("", {"receiver.unit=3", "receiver.population=parts"}),
            "receiver.unit = 3 in --set with receiver.population in --set (a population draws "
            "another unit in each trial) remove one of the two");
}

TEST(ReceiverUnit, IsRefusedOfAnIdealReceiver) {
  EXPECT_EQ(refusal("", {"receiver.unit=3", "receiver.module=ideal-coherent"}),
            "receiver.unit = 3 in --set with receiver.module = \"ideal-coherent\" in --set (an "
            "ideal receiver is that of theory, so all units of it are alike) use a module, or no "
            "unit");
  EXPECT_EQ(refusal("", {"receiver.unit=0", "receiver.module=ideal-coherent"}), "accepted");
}

TEST(ReceiverUnit, OfADoubtAreASweepThatComesLast) {
  const LoadedScenario scenario = loaded("", {"--doubt", "receiver.range_m=1,2"});
  ASSERT_EQ(scenario.sweep.size(), 2u);
  EXPECT_EQ(scenario.sweep[1].key, unit_key);
  EXPECT_EQ(scenario.sweep[1].values.size(), 32u);
  EXPECT_EQ(loaded(scenario.text).sweep[1].values, scenario.sweep[1].values) << "it repeats itself";
}

TEST(ReceiverUnit, OfADoubtAreNotChosenTwice) {
  const auto twice = [](const std::string& place) {
    return "--doubt with receiver.unit " + place +
           " (both say which units there are) remove one of the two";
  };
  EXPECT_EQ(refusal("", {"--doubt", "receiver.unit=0"}), twice("in --set"));
  EXPECT_EQ(refusal("", {"receiver.unit=1:1:8", "--doubt"}), twice("in --set"));
  EXPECT_EQ(refusal("[receiver]\nunit = 3", {"--doubt"}), twice("in x.toml:2"));
  EXPECT_EQ(refusal("[sweep]\nreceiver.unit = \"1:1:8\"", {"--doubt"}), twice("in x.toml:2"));
}

TEST(ReceiverUnit, OfADoubtAreRefusedWhereNothingIsDrawn) {
  EXPECT_EQ(refusal("", {"--doubt", "receiver.module=ideal-coherent"}),
            "receiver.unit = 1 by --doubt with receiver.module = \"ideal-coherent\" in --set (an "
            "ideal receiver is that of theory, so all units of it are alike) use a module, or no "
            "unit");
}

TEST(Population, OfConstantsDrawsWhatNobodyPrinted) {
  const Link parts = link_of({"receiver.population=parts"});
  const Link constants = link_of({"receiver.population=constants"});
  EXPECT_EQ(drawn_module(parts, 5).agc_attack_db_per_ms, tsop4856().agc_attack_db_per_ms);
  const auto one = drawn_module(constants, 5), other = drawn_module(constants, 6);
  EXPECT_NE(one.agc_attack_db_per_ms, tsop4856().agc_attack_db_per_ms);
  EXPECT_NE(one.agc_attack_db_per_ms, other.agc_attack_db_per_ms);
  EXPECT_NE(one.centre_hz, other.centre_hz);
  EXPECT_EQ(link_of({"receiver.population=true"}).point, parts.point);
  EXPECT_NE(constants.point, parts.point);
}

// At 5 m some constants carry and some do not.
TEST(Population, OfConstantsLosesWithSomeUnits) {
  const Link link = link_of({"receiver.population=constants", "receiver.range_m=5",
                             "device.interval_min_ms=300", "simulation.warmup_messages=2"});
  Tally tally;
  for (std::uint32_t first = 0; first < 64; first += 8) tally += run_group(link, first, 8).tally;
  EXPECT_GT(tally.n_frames_lost, 6u);
  EXPECT_LT(tally.n_frames_lost, 58u);
}

// A low supply raises drawn thresholds as it raises typical ones.
TEST(Population, BoundsOfTheThresholdMoveWithItsConditions) {
  const auto part = load_module("TSOP4156", {{COSYS_SOURCE_DIR "/scenarios"}, {}, {}}, "").data;
  const auto low = channel::under({.ripple_mv_rms = 0}, part);
  EXPECT_EQ(bounds_of(low, "emin_mw_per_m2")->high, bounds_of(part, "emin_mw_per_m2")->high);
  channel::ModuleData sensitive = part;
  sensitive.emin_against_supply = {{2, 5}, {0.24, 0.12}};
  const auto raised = channel::under({.supply_v = 2}, sensitive);
  EXPECT_NEAR(bounds_of(raised, "emin_mw_per_m2")->high,
              2 * bounds_of(part, "emin_mw_per_m2")->high, 1e-12);
}

// Whatever a shipped part's file says is assumed, it also says between which bounds.
TEST(PartFiles, EveryAssumedNumberHasBounds) {
  const std::regex number("^(\\w+) = \\{ value = .*");
  int assumed = 0;
  for (const PartFile& part : list_parts({COSYS_SOURCE_DIR "/scenarios"})) {
    std::ifstream file(part.path);
    for (std::string line; std::getline(file, line);) {
      if (!std::regex_match(line, number) || line.find("assumed") == std::string::npos) continue;
      ++assumed;
      EXPECT_NE(line.find("low = "), std::string::npos) << part.path << ": " << line;
    }
  }
  EXPECT_GT(assumed, 50);
}

// Each kind of gain control has its own reason for the least and the greatest speed, or says that
// nothing is known of it.
TEST(PartFiles, BoundsOfTheSpeedNameTheReasonOfTheirKind) {
  const char* note = "35 m at 1200 bit/s with one TSAL6200";
  const char* reports = "lets go of a carrier without end after 600 to 1000 ms";
  const std::map<std::string, std::vector<const char*>> reasons{
      {note, {"tsdp34156", "tsop31156", "tsop4156"}},  // AGC1
      {reports, {"tsop34856", "tsop38256", "tsop4856", "tsop57256", "tsop94256"}},
      {"nothing is printed or reported of AGC3", {"tsop4356"}},
      {"nothing is printed or reported of AGC4", {"tsop38456", "tsop4456", "tsop94456"}},
      {"nothing is printed or reported of AGC5", {"tsop39556"}},
      {"nothing is printed or reported of AGC6", {"tsop94656"}}};
  std::size_t parts = 0;
  for (const auto& [reason, names] : reasons)
    for (const char* name : names) {
      const CarriedPart file =
          load_module(name, {{COSYS_SOURCE_DIR "/scenarios"}, {}, {}}, "").source;
      const std::vector<Entry> entries = read_entries(file.text, file.file);
      const auto source = std::ranges::find(entries, "agc_attack_db_per_ms.source", &Entry::key);
      ASSERT_NE(source, entries.end()) << name;
      EXPECT_NE(std::get<std::string>(source->value).find(reason), std::string::npos) << name;
      ++parts;
    }
  EXPECT_EQ(parts, 14U) << "all that have a gain control";
}

// No data sheet prints how fast a gain control is.
TEST(PartFiles, EveryGainControlHasBoundsOfItsSpeed) {
  int controls = 0;
  for (const PartFile& file : list_parts({COSYS_SOURCE_DIR "/scenarios"})) {
    if (file.kind != module_keys().kind) continue;
    const auto part = load_module(file.name, {{COSYS_SOURCE_DIR "/scenarios"}, {}, {}}, "").data;
    if (channel::is_matched(part) || part.agc_attack_db_per_ms == 0) continue;
    ++controls;
    EXPECT_TRUE(bounds_of(part, "agc_attack_db_per_ms")) << file.name;
    EXPECT_TRUE(bounds_of(part, "agc_range_db")) << file.name;
    EXPECT_TRUE(bounds_of(part, "agc_max_duty")) << file.name;
  }
  EXPECT_EQ(controls, 14);
}

}  // namespace
}  // namespace sim
