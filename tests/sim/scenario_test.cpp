#include "sim/scenario.hpp"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "gtest/gtest.h"
#include "sim/canonical_text.hpp"
#include "sim/entries.hpp"
#include "sim/failure.hpp"
#include "sim/keys.hpp"
#include "sim/point_scenario.hpp"
#include "sim/sweep.hpp"

namespace {

namespace fs = std::filesystem;
using sim::Key;
using sim::LoadedScenario;
using sim::Scenario;

const fs::path scenarios = fs::path(COSYS_SOURCE_DIR) / "scenarios";

LoadedScenario parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return sim::parse_scenario(text, "x.toml", overrides, {scenarios});
}

std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const sim::Failure& failure) {
    EXPECT_EQ(failure.code(), sim::ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

/// A value that a number may have besides its default, close enough not to contradict other keys.
double other_value(const Key& key) {
  Scenario defaults;
  const double standard = key.number(defaults);
  if (key.facts.type == sim::KeyType::whole_number) return standard + 1;
  const double up = standard == 0 ? 1.0 / 64 : standard * 1.0078125;
  return key.facts.range.contains(up) ? up : standard * 0.984375;
}

std::string other_text(const Key& key) {
  if (key.name() == "led.part") return "tsal6200";
  if (key.name() == "receiver.module") return "tsop4856";
  return key.facts.type == sim::KeyType::choice ? "mid-bit" : "RFID \"S:\\U";
}

std::string in_toml(const Key& key, const std::string& value) {
  return key.is_number() ? key.name() + " = " + value + "\n" : key.name() + " = '" + value + "'\n";
}

std::string other(const Key& key) {
  return key.is_number() ? fmt::format("{}", other_value(key)) : other_text(key);
}

TEST(ScenarioLaw, EveryKeyIsSetByFileAndBySetAlike) {
  for (const Key& key : sim::scenario_keys()) {
    LoadedScenario file = parse(in_toml(key, other(key)));
    LoadedScenario set = parse("", {key.name() + "=" + other(key)});
    if (key.is_number()) {
      EXPECT_EQ(key.number(file.base), other_value(key)) << key.name();
      EXPECT_EQ(key.number(set.base), other_value(key)) << key.name();
    } else {
      EXPECT_EQ(key.text(file.base), other_text(key)) << key.name();
      EXPECT_EQ(key.text(set.base), other_text(key)) << key.name();
    }
    EXPECT_EQ(sim::canonical_text(file.base), sim::canonical_text(set.base)) << key.name();
    EXPECT_EQ(file.places.at(key.name()), "in x.toml:1");
    EXPECT_EQ(set.places.at(key.name()), "in --set");
  }
}

TEST(ScenarioLaw, EveryNumberSweepsAndOnlyItChanges) {
  for (const Key& key : sim::scenario_keys()) {
    if (!key.is_number()) continue;
    Scenario defaults;
    const std::string values = fmt::format("{},{}", key.number(defaults), other_value(key));
    const auto swept = parse("[sweep]\n\"" + key.name() + "\" = \"" + values + "\"\n");
    ASSERT_EQ(swept.sweep.size(), 1U) << key.name();
    EXPECT_EQ(swept.sweep[0].unit, key.facts.unit);
    EXPECT_EQ(swept.sweep[0].long_name, key.facts.long_name);
    const auto fixed = parse("", {key.name() + "=" + other(key)});
    Scenario point = sim::point_scenario(swept, {other_value(key)});
    EXPECT_EQ(key.number(point), other_value(key));
    EXPECT_EQ(sim::canonical_text(point), sim::canonical_text(fixed.base)) << key.name();
    EXPECT_EQ(parse("", {key.name() + "=" + values}).sweep[0].values, swept.sweep[0].values);
  }
}

TEST(ScenarioLaw, AnEmptyFileIsTheStructsDefaults) {
  Scenario loaded = parse("").base, defaults;
  for (const Key& key : sim::scenario_keys())
    if (key.is_number())
      EXPECT_EQ(key.number(loaded), key.number(defaults)) << key.name();
    else
      EXPECT_EQ(key.text(loaded), key.text(defaults)) << key.name();
}

TEST(ScenarioLaw, CanonicalTextTellsPhysicsAndNothingElse) {
  const std::string standard = sim::canonical_text(parse("").base);
  for (const Key& key : sim::scenario_keys()) {
    const bool physics = key.name() != "title" && key.facts.type != sim::KeyType::part &&
                         key.name() != "simulation.seed" && !key.name().starts_with("stop.");
    const auto changed = sim::canonical_text(parse(in_toml(key, other(key))).base);
    EXPECT_EQ(changed != standard, physics) << key.name();
  }
}

TEST(ScenarioLaw, CanonicalTextTellsTheCurvesOfTheParts) {
  const Scenario base = parse("").base;
  for (int curve = 0; curve < 3; ++curve) {
    Scenario s = base;
    auto& changed = curve == 0   ? s.module.directivity
                    : curve == 1 ? s.emitter.intensity_mw_per_sr
                                 : s.emitter.pattern;
    changed.y[1] = std::nextafter(changed.y[1], 2);
    EXPECT_NE(sim::canonical_text(s), sim::canonical_text(base)) << curve;
  }
}

TEST(ScenarioLaw, CanonicalTextTellsTheLastBitOfANumber) {
  for (const Key& key : sim::scenario_keys()) {
    if (!key.is_number() || key.name().starts_with("stop.") || key.name() == "simulation.seed")
      continue;
    Scenario s = parse("").base;
    const std::string before = sim::canonical_text(s);
    key.number(s) = std::nextafter(key.number(s), 1e300);
    EXPECT_NE(sim::canonical_text(s), before) << key.name();
  }
}

TEST(ScenarioLaw, CanonicalTextDoesNotDependOnThePlaceInASweep) {
  const auto a = parse("[sweep]\nreceiver.range_m = \"0.1:0.1:0.5\"\nled.yaw_deg = [-0.0, 5]");
  const auto b = parse("[sweep]\nled.yaw_deg = \"5:-5:0\"\nreceiver.range_m = [7, 0.3]");
  EXPECT_EQ(sim::canonical_text(sim::point_scenario(a, sim::point_coordinates(a.sweep, 4))),
            sim::canonical_text(sim::point_scenario(b, sim::point_coordinates(b.sweep, 3))));
}

TEST(ScenarioLaw, TheKeptTextRepeatsTheRun) {
  const std::string text = "title = \"a\"\n[sweep]\nreceiver.range_m = [1, 2]\n[led]\nyaw_deg = 3";
  const std::vector<std::string> overrides{"title=q\"u\\o\tt=e", "led.yaw_deg=4,5",
                                           "device.message=x \"\\ y", "receiver.range_m=3",
                                           "receiver.range_m=3:1:5"};
  for (std::size_t n = 0; n <= overrides.size(); ++n) {
    std::vector<std::string> some(overrides.begin(), overrides.begin() + static_cast<long>(n));
    if (n > 0) some[0] = "title=q\"u\\o = \xc3\xa4";
    const auto first = parse(text, some);
    const auto again = parse(first.text);
    EXPECT_EQ(again.base.title, first.base.title);
    EXPECT_EQ(sim::canonical_text(again.base), sim::canonical_text(first.base));
    ASSERT_EQ(again.sweep.size(), first.sweep.size());
    for (std::size_t i = 0; i < first.sweep.size(); ++i) {
      EXPECT_EQ(again.sweep[i].key, first.sweep[i].key);
      EXPECT_EQ(again.sweep[i].values, first.sweep[i].values);
    }
  }
}

TEST(Scenario, ModuleKeysOverrideTheirPart) {
  const auto s = parse("[module]\nq = 7\n[receiver]\nmodule = \"tsop4856\"").base;
  EXPECT_EQ(s.module.q, 7);
  EXPECT_EQ(s.module.centre_hz, 56000);
  EXPECT_FALSE(s.module.directivity.empty());
  EXPECT_EQ(s.emitter.name, "TSAL6200");
}

TEST(Scenario, SweepKeepsTheOrderOfTheFileAndSetActsOnIt) {
  const std::string text =
      "[sweep]\nreceiver.range_m = \"1:1:3\"\nreceiver.bearing_deg = 5\n"
      "'led.current_ma' = [10, 20]\ndevice.baud = \"300\"\n";
  const auto keys = [](const LoadedScenario& loaded) {
    std::string names;
    for (const auto& axis : loaded.sweep)
      names += fmt::format("{}:{} ", axis.key, axis.values.size());
    return names;
  };
  EXPECT_EQ(keys(parse(text)),
            "receiver.range_m:3 receiver.bearing_deg:1 led.current_ma:2 device.baud:1 ");
  EXPECT_EQ(keys(parse(text, {"receiver.bearing_deg=0", "led.current_ma=1,2,3"})),
            "receiver.range_m:3 led.current_ma:3 device.baud:1 ");
  const auto one = parse(text, {"receiver.range_m=9", "floor.roughness_um=0:1:3"});
  EXPECT_EQ(keys(one),
            "receiver.bearing_deg:1 led.current_ma:2 device.baud:1 floor.roughness_um:4 ");
  EXPECT_EQ(one.base.receiver.range_m, 9);
}

struct Refusal {
  const char* text;
  const char* message;
};

class ScenarioRefuses : public testing::TestWithParam<Refusal> {};

TEST_P(ScenarioRefuses, InOneLineWithFileAndLine) {
  EXPECT_EQ(refusal(GetParam().text), GetParam().message);
}

const Refusal refusals[] = {
    {"\n[receiver]\nrange_m = -1",
     "receiver.range_m = -1 in x.toml:3 (distance along the floor must be above 0 m) use a value "
     "above 0 up to 1000"},
    {"[receiver]\nrange_m = 0",
     "receiver.range_m = 0 in x.toml:2 (distance along the floor must be above 0 m) use a value "
     "above 0 up to 1000"},
    {"[device]\n\n\ncarrier_duty = 1",
     "device.carrier_duty = 1 in x.toml:4 (lit fraction of a carrier period must be at most 0.99) "
     "use a value 0.01 to 0.99"},
    {"[device]\nbaud = inf",
     "device.baud = inf in x.toml:2 (not a finite number) use a value 1 to 100000"},
    {"[device]\nbaud = nan",
     "device.baud = nan in x.toml:2 (not a finite number) use a value 1 to 100000"},
    {"stop.max_frames = 1.5",
     "stop.max_frames = 1.5 in x.toml:1 (messages after which a point ends: only whole numbers) "
     "use "
     "a whole number 1 to 4000000000"},
    {"simulation.seed = 9007199254740993",
     "simulation.seed = 9007199254740992 in x.toml:1 (seed of all randomness must be at most "
     "9007199254740991) use a whole number 0 to 9007199254740991"},
    {"[receiver]\nrange = 3",
     "receiver.range in x.toml:2 (no such key) did you mean receiver.range_m?"},
    {"range_m = 3", "range_m in x.toml:1 (no such key) did you mean receiver.range_m?"},
    {"[reciever]\nrange_m = 3",
     "reciever.range_m in x.toml:2 (no such key) did you mean receiver.range_m?"},
    {"\n[sweeps]\n", "[sweeps] in x.toml:2 (no such table) did you mean [sweep]?"},
    {"[receiver]\nrange_m = \"3\"",
     "receiver.range_m in x.toml:2 (text where a number is expected) write a number without "
     "quotes; "
     "sweep in [sweep]"},
    {"[receiver]\nrange_m = [1, 2]",
     "receiver.range_m in x.toml:2 (a list where a number is expected) write a number without "
     "quotes; sweep in [sweep]"},
    {"[receiver]\nrange_m = true",
     "receiver.range_m in x.toml:2 (true or false where a number is expected) write a number "
     "without quotes; sweep in [sweep]"},
    {"[device]\nmessage = 5",
     "device.message in x.toml:2 (a number where text is expected) write the text in quotes"},
    {"[device]\nmessage = \"a\\nb\"",
     "device.message = \"a?b\" in x.toml:2 (a message is printable ASCII, from space to ~) remove "
     "the other characters"},
    {"title = \"a\\tb\"",
     "title = \"a?b\" in x.toml:1 (a text is one line without control characters) remove them"},
    {"[uart]\nreceiver = \"avr\"",
     "uart.receiver = \"avr\" in x.toml:2 (the listening UART is one of a list) use atmega or "
     "mid-bit"},
    {"\"led.yaw_deg\" = 1\n[led]\nyaw_deg = 2",
     "led.yaw_deg in x.toml:3 (given twice in this file) remove one of the two"},
    {"[sweep]\n'led.yaw_deg' = 1\nled.yaw_deg = 2",
     "sweep.led.yaw_deg in x.toml:3 (given twice in this file) remove one of the two"},
    {"[sweep]\nled.yaw_deg = [1, 2, 1]",
     "led.yaw_deg = 1 in x.toml:2 (twice in the same sweep) remove one of the two"},
    {"[sweep]\nled.yaw_deg = []",
     "led.yaw_deg in x.toml:2 (an empty sweep) write a:step:b, such as 1:0.5:20, or a list, such "
     "as "
     "1,2,5"},
    {"[sweep]\nled.yaw_deg = \"1:0:2\"",
     "led.yaw_deg = \"1:0:2\" in x.toml:2 (the step is zero) write a:step:b, such as 1:0.5:20, or "
     "a "
     "list, such as 1,2,5"},
    {"[sweep]\nled.yaw_deg = \"1:1:200\"",
     "led.yaw_deg = 181 in x.toml:2 (direction of the LED along the floor must be at most 180 "
     "degree) use a value -180 to 180"},
    {"[sweep]\nstop.max_frames = [1, 2.5]",
     "stop.max_frames = 2.5 in x.toml:2 (messages after which a point ends: only whole numbers) "
     "use "
     "a whole number 1 to 4000000000"},
    {"[sweep]\nled.yaw_deg = [1, \"2\"]",
     "sweep.led.yaw_deg in x.toml:2 (a list that is not of numbers where a range or list is "
     "expected) write \"1:1:20\" or [1, 2, 5]"},
    {"[sweep]\nled.part = [1]",
     "led.part in x.toml:2 (text cannot be swept) write one scenario for each text"},
    {"[sweep]\nyaw_dge = 1", "yaw_dge in x.toml:2 (no such key) did you mean led.yaw_deg?"},
    {"[sweep]\nled.yaw_deg = \"0:0.1:100\"\nreceiver.yaw_deg = \"0:0.1:100\"",
     "the sweep up to receiver.yaw_deg (more than 1000000 points) use a larger step or fewer axes"},
    {"[device]\ninterval_min_ms = 1000",
     "device.interval_min_ms = 1000 in x.toml:2 with device.interval_max_ms = 900 by default (the "
     "shortest pause cannot exceed the longest) lower device.interval_min_ms to 900 or raise "
     "device.interval_max_ms to 1000"},
    {"[sweep]\nsimulation.sample_rate_hz = [1e6, 230e3]\n[module]\ncentre_hz = 38000",
     "device.carrier_hz = 59000 by default with simulation.sample_rate_hz = 230000 in x.toml:2 (a "
     "carrier period takes at least 4 samples) lower device.carrier_hz to 57500 or raise "
     "simulation.sample_rate_hz to 236000"},
    {"module.centre_hz = 2.6e5",
     "module.centre_hz = 260000 in x.toml:1 with simulation.sample_rate_hz = 600000 by default (a "
     "period of the band-pass takes at least 4 samples) lower module.centre_hz to 150000 or raise "
     "simulation.sample_rate_hz to 1040000"},
    {"device.carrier_hz = 2e3",
     "device.baud = 600 by default with device.carrier_hz = 2000 in x.toml:1 (a bit takes at least "
     "4 carrier periods) lower device.baud to 500 or raise device.carrier_hz to 2400"},
    {"device.baud = 12e3",
     "device.baud = 12000 in x.toml:1 with simulation.sample_rate_hz = 600000 by default (a bit "
     "takes at least 100 samples) lower device.baud to 6000 or raise simulation.sample_rate_hz to "
     "1200000"},
    {"module.emax_w_per_m2 = 1e-5",
     "module.emin_mw_per_m2 = 0.12 from the part with module.emax_w_per_m2 = 1e-05 in x.toml:1 "
     "(the "
     "threshold cannot exceed the largest irradiance) lower module.emin_mw_per_m2 to 0.01 or raise "
     "module.emax_w_per_m2 to 0.00012"},
    {"[[override]]\nset = 'led.yaw_deg=x'",
     "led.yaw_deg = x in x.toml:2 (\"x\" is not a number) write a:step:b, such as 1:0.5:20, or a "
     "list, such as 1,2,5"},
};

INSTANTIATE_TEST_SUITE_P(Files, ScenarioRefuses, testing::ValuesIn(refusals));

TEST(Scenario, SetIsRefusedUnderItsOwnName) {
  EXPECT_EQ(refusal("", {"led.yaw_deg"}),
            "\"led.yaw_deg\" in --set (no = in it) write key=value, such as receiver.range_m=3");
  EXPECT_EQ(refusal("", {"led.yaw=3"}), "led.yaw in --set (no such key) did you mean led.yaw_deg?");
  EXPECT_EQ(refusal("", {"receiver.range_m=-1"}),
            "receiver.range_m = -1 in --set (distance along the floor must be above 0 m) use a "
            "value above 0 up to 1000");
  EXPECT_EQ(refusal("", {"led.yaw_deg="}),
            "led.yaw_deg =  in --set (no value) write a:step:b, such as 1:0.5:20, or a list, such "
            "as 1,2,5");
  EXPECT_EQ(refusal("", {"title=\xff"}).substr(0, 22), "syntax error in --set:");
  EXPECT_EQ(refusal("", {"device.message="}), "accepted");
  EXPECT_EQ(refusal("", {"device.message=" + std::string(250, 'x')}), "accepted");
  EXPECT_NE(refusal("", {"device.message=" + std::string(251, 'x')}).find("at most 250"),
            std::string::npos);
}

TEST(Scenario, AnUnknownPartNamesTheNearestAndWhereItWasSought) {
  EXPECT_EQ(refusal("\n[receiver]\nmodule = \"TSOP4857\""),
            "receiver.module = \"TSOP4857\" in x.toml:3 (no module of this name in " +
                (scenarios / "modules").generic_string() + ") did you mean tsop4856?");
  EXPECT_THROW(sim::parse_scenario("", "x.toml", {}, {}), sim::Failure);
}

TEST(Scenario, SyntaxErrorsHaveTheirLine) {
  EXPECT_EQ(refusal("[led]\nyaw_deg = \n").substr(0, 24), "syntax error in x.toml:2");
  EXPECT_EQ(refusal("[led]\n\nyaw_deg = 1\nyaw_deg = 2\n").substr(0, 24),
            "syntax error in x.toml:4");
  EXPECT_EQ(refusal("title = \"\xff\"").substr(0, 24), "syntax error in x.toml:1");
}

TEST(Scenario, FilesThatAreNone) {
  const auto answer = [](const fs::path& path) -> std::string {
    try {
      sim::load_scenario(path, {}, {scenarios});
    } catch (const sim::Failure& failure) {
      return failure.what();
    }
    return "accepted";
  };
  EXPECT_EQ(answer("no/such.toml"), "no/such.toml (no such file) check the path");
  EXPECT_EQ(answer(scenarios), scenarios.generic_string() +
                                   " (a folder, not a scenario file) name a .toml file in it");
  EXPECT_EQ(answer("/dev/zero"), "/dev/zero (longer than 1 MiB) name a scenario file");
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
  const std::string good = sim::read_text_file(scenarios / "quickstart.toml", "scenario");
  std::mt19937 random(3);
  int refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const std::string text = mutated(good, random);
    try {
      parse(text);
    } catch (const sim::Failure& failure) {
      ++refused;
      EXPECT_EQ(failure.code(), sim::ExitCode::bad_input);
      EXPECT_EQ(std::string(failure.what()).find('\n'), std::string::npos) << text;
    }
  }
  EXPECT_GT(refused, 500);
}

TEST(ScenarioLaw, DeepNestingIsRefused) {
  std::string dots = "\na", stairs;
  for (int i = 0; i < 100'000; ++i) dots += ".a";
  for (int i = 0; i < 200; ++i) {
    stairs += "a";
    for (int j = 0; j < 200; ++j) stairs += ".a";
    stairs += " = [{\n";
  }
  EXPECT_EQ(refusal(dots + " = 1"),
            "syntax error in x.toml:2 (more than 250 dots in a line) break the line in two");
  EXPECT_EQ(refusal("a = " + std::string(100'000, '[')).substr(0, 24), "syntax error in x.toml:1");
  EXPECT_EQ(refusal(stairs).substr(0, 23), "syntax error in x.toml:");
}

}  // namespace
