#include "sim/components/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "channel/emitter.hpp"
#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/failure.hpp"
#include "sim/scenario/keys.hpp"

namespace {

using sim::scenarios;

namespace fs = std::filesystem;

channel::ModuleData module_of(const std::string& name, const sim::PartRoots& folders,
                              const std::string& asked = "") {
  return sim::load_module(name, {folders, {}, {}}, asked).data;
}

channel::EmitterData led_of(const std::string& name, const sim::PartRoots& folders) {
  return sim::load_led(name, {folders, {}, {}}, "").data;
}

// A folder of parts that lasts as long as one test.
class Parts : public testing::Test {
 protected:
  Parts() {
    for (const char* folder : {"modules", "leds"}) fs::create_directories(root_ / folder);
  }
  ~Parts() override { fs::remove_all(root_); }

  void write(const std::string& file, const std::string& text) const {
    std::ofstream(root_ / file) << text;
  }

  /// What loading module "X" from a file of this text answers, the folder's name cut out.
  std::string refusal(const std::string& text) const {
    write("modules/x.toml", text);
    return answer("X");
  }

  std::string answer(const std::string& name) const {
    try {
      module_of(name, {root_}, "asked");
    } catch (const sim::Failure& failure) {
      EXPECT_EQ(failure.code(), sim::ExitCode::bad_input);
      std::string line = failure.what();
      for (auto at = line.find(root_.string()); at != std::string::npos;
           at = line.find(root_.string()))
        line.replace(at, root_.string().size(), "R");
      return line;
    }
    return "accepted";
  }

  const fs::path root_ =
      fs::path(testing::TempDir()) /
      (std::string("parts_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

std::string number(const std::string& name, const std::string& value) {
  return name + " = { value = " + value + ", source = \"s\" }\n";
}

// Six lines: the name and what is required of a module.
const std::string least = "name = \"X\"\n" + number("centre_hz", "38000") +
                          number("emin_mw_per_m2", "0.2") + number("emax_w_per_m2", "30") +
                          number("agc_max_duty", "0.3") + number("agc_long_burst_cycles", "70") +
                          number("agc_min_gap_cycles", "10");

TEST_F(Parts, EveryNumberOfAModuleIsRead) {
  for (const auto& field : sim::module_keys().numbers) {
    const double value = (field.facts.range.low + field.facts.range.high) / 2;
    std::string text = "name = \"X\"\n";
    for (const auto& other : sim::module_keys().numbers)
      if (other.facts.name != field.facts.name &&
          (other.required || (other.facts.name == "agc_long_burst_cycles" &&
                              field.facts.name != "agc_long_burst_ms")))
        text += number(other.facts.name, fmt::format("{}", channel::ModuleData{}.*other.member));
    write("modules/x.toml", text + number(field.facts.name, fmt::format("{}", value)));
    EXPECT_EQ(module_of("x", {root_}).*field.member, value) << field.facts.name;
  }
}

TEST_F(Parts, WhatAModuleLeavesOutHasTheStructsDefault) {
  write("modules/x.toml", least);
  const auto module = module_of("X", {root_});
  EXPECT_EQ(module.centre_hz, 38000);
  EXPECT_EQ(module.q, channel::ModuleData{}.q);
  EXPECT_TRUE(module.directivity.empty());
}

TEST_F(Parts, RefusesWithFileLineAndRemedy) {
  EXPECT_EQ(refusal(least), "accepted");
  EXPECT_EQ(refusal("name = \"X\"\ncentre_hz = 5\n"),
            "centre_hz in R/modules/x.toml:2 (a number without its source) write centre_hz = { "
            "value = NUMBER, source = \"document, page\" }");
  EXPECT_EQ(refusal("name = \"X\"\ncentre_hz = { value = 38000 }\n"),
            "centre_hz in R/modules/x.toml:2 (without its source) add source = \"document, page\" "
            "to it");
  EXPECT_EQ(refusal("name = \"X\"\ncentre_hz = { value = 38000, source = \"\" }\n"),
            "centre_hz.source in R/modules/x.toml:2 (empty) add source = \"document, page\" to it");
  EXPECT_EQ(refusal("name = \"X\"\n"),
            "centre_hz in R/modules/x.toml (missing, and no default can be right) add "
            "centre_hz = { value = NUMBER, source = \"document, page\" }");
  EXPECT_EQ(refusal("name = \"X\"\n" + number("centre_hz", "-5")),
            "centre_hz = -5 in R/modules/x.toml:2 (centre of the band-pass must be at least 1000 "
            "Hz) use a value 1000 to 1000000");
  EXPECT_EQ(refusal(least + number("qq", "5")),
            "qq.value in R/modules/x.toml:8 (no such key in a part file) did you mean q?");
  EXPECT_EQ(refusal(least + number("agc_duty_max", "0.3")),
            "agc_duty_max.value in R/modules/x.toml:8 (no such key in a part file) did you mean "
            "agc_max_duty?");
  EXPECT_EQ(refusal(least + "agc_duty_max = 0.3\n"),
            "agc_duty_max in R/modules/x.toml:8 (no such key in a part file) did you mean "
            "agc_max_duty?");
  EXPECT_EQ(refusal(least + "agc_hold_ms = { valu = 3, source = \"s\" }\n"),
            "agc_hold_ms.valu in R/modules/x.toml:8 (no such key in a part file) did you mean "
            "agc_hold_ms.value?");
  EXPECT_EQ(refusal(least + "q = { value = \"5\", source = \"s\" }"),
            "q.value in R/modules/x.toml:8 (text where a number is expected) write q = { value = "
            "NUMBER, source = \"document, page\" }");
  EXPECT_EQ(refusal(""), "name in R/modules/x.toml (missing) add name = \"x\"");
  EXPECT_EQ(refusal("name = \"Y\""),
            "name = \"Y\" in R/modules/x.toml:1 (the file has another name) rename one of the two");
}

TEST_F(Parts, NumbersMayHaveBounds) {
  write(
      "modules/x.toml",
      least +
          "q = { value = 10, low = 8, high = 13, distribution = \"log-uniform\", source = \"s\" }");
  const auto module = module_of("X", {root_});
  const auto q = std::ranges::find(module.bounds, "q", &channel::NumberBounds::number);
  ASSERT_NE(q, module.bounds.end());
  EXPECT_EQ(q->low, 8);
  EXPECT_EQ(q->high, 13);
  EXPECT_EQ(q->distribution, channel::Distribution::log_uniform);
  // What the file gives without bounds is known; what no sheet prints is not.
  const auto has = [&](const char* number) {
    return std::ranges::count(module.bounds, number, &channel::NumberBounds::number);
  };
  EXPECT_EQ(has("agc_max_duty"), 0);
  EXPECT_EQ(has("agc_attack_db_per_ms"), 1);
}

TEST_F(Parts, RefusesBoundsThatBoundNothing) {
  const auto q = [&](const std::string& rest) {
    return refusal(least + "q = { value = 10, " + rest + "source = \"s\" }");
  };
  EXPECT_EQ(q("low = 8, high = 12, "), "accepted");
  EXPECT_EQ(q("low = 8, "), "q.high in R/modules/x.toml (missing) add low and high, or neither");
  EXPECT_EQ(q("low = 11, high = 12, "),
            "q = 11 to 12 in R/modules/x.toml:8 (the value 10 is not between them) correct value, "
            "low or high");
  EXPECT_EQ(q("low = 0.1, high = 12, "),
            "q.low = 0.1 in R/modules/x.toml:8 (quality factor of the band-pass must be above 0.5) "
            "use a value above 0.5 up to 100");
  EXPECT_EQ(q("low = nan, high = 12, "),
            "q.low = nan in R/modules/x.toml:8 (not a finite number) use a value above 0.5 up to "
            "100");
  EXPECT_EQ(q("distribution = \"uniform\", "),
            "q.distribution in R/modules/x.toml:8 (nothing to distribute) add low and high");
  EXPECT_EQ(q("low = 8, high = 12, distribution = \"normal\", "),
            "q.distribution = \"normal\" in R/modules/x.toml:8 (no such distribution) use "
            "\"uniform\" or \"log-uniform\"");
  EXPECT_EQ(
      refusal(least + "agc_margin_db = { value = 3, low = 0, high = 6, distribution = "
                      "\"log-uniform\", source = \"s\" }"),
      "agc_margin_db.low = 0 in R/modules/x.toml:8 (the logarithm of 0 has no bound) raise it "
      "or use \"uniform\"");
}

TEST_F(Parts, APartMayBeLikeAnother) {
  write("modules/a.toml", "name = \"A\"\n" + least.substr(least.find('\n') + 1) +
                              "q = { value = 7, low = 6, high = 8, source = \"s\" }\n"
                              "[directivity]\ndegrees = [0, 90]\nrelative_distance = [1, 0]\n"
                              "source = \"s\"\n");
  write("modules/x.toml", "name = \"X\"\nlike = \"a\"\n" + number("emin_mw_per_m2", "0.5") +
                              number("agc_long_burst_ms", "2"));
  const sim::Part<channel::ModuleData> x = sim::load_module("X", {{root_}, {}, {}}, "");
  EXPECT_EQ(x.data.name, "X");
  EXPECT_EQ(x.data.emin_mw_per_m2, 0.5);
  EXPECT_EQ(x.data.centre_hz, 38000);
  EXPECT_EQ(x.data.q, 7);
  EXPECT_EQ(std::ranges::count(x.data.bounds, "q", &channel::NumberBounds::number), 1);
  EXPECT_FALSE(x.data.directivity.empty());
  EXPECT_EQ(x.data.agc_long_burst_ms, 2);
  EXPECT_EQ(x.data.agc_long_burst_cycles, channel::ModuleData{}.agc_long_burst_cycles);
  ASSERT_EQ(x.siblings.size(), 1U);
  EXPECT_EQ(x.siblings[0].file, "modules/a.toml");
}

// An LED has a pattern or an angle: the one that is given takes the place of the sibling's other.
TEST_F(Parts, AnLedMayBeLikeAnother) {
  const std::string intensity =
      "[intensity]\nma = [1, 100]\nmw_per_sr = [1, 100]\nsource = \"s\"\n";
  write("leds/a.toml", "name = \"A\"\n" + intensity +
                           "[pattern]\ndegrees = [0, 90]\nrelative_intensity = [1, 0]\n"
                           "source = \"s\"\n");
  write("leds/x.toml", "name = \"X\"\nlike = \"A\"\n" + number("half_angle_deg", "20"));
  const auto x = led_of("X", {root_});
  EXPECT_EQ(x.half_angle_deg, 20);
  EXPECT_TRUE(x.pattern.empty());
  EXPECT_FALSE(x.intensity_mw_per_sr.empty());
}

TEST_F(Parts, WhatIsGivenOfASiblingsNumberIsKnown) {
  write("modules/a.toml", "name = \"A\"\n" + least.substr(least.find('\n') + 1) +
                              "q = { value = 7, low = 6, high = 8, source = \"s\" }\n");
  write("modules/x.toml", "name = \"X\"\nlike = \"A\"\n" + number("q", "9"));
  const auto x = module_of("X", {root_});
  EXPECT_EQ(x.q, 9);
  EXPECT_EQ(std::ranges::count(x.bounds, "q", &channel::NumberBounds::number), 0);
}

TEST_F(Parts, RefusesSiblingsThatAreNone) {
  EXPECT_EQ(
      refusal("name = \"X\"\nlike = \"X\"\n"),
      "like = \"X\" in R/modules/x.toml:2 (parts that are like each other in a circle have no "
      "numbers) give one of them its own");
  EXPECT_EQ(refusal("name = \"X\"\nlike = \"nobody\"\n"),
            "like = \"nobody\" in R/modules/x.toml:2 (no module of this name in R/modules) "
            "cosys-sim parts lists all that there are");
  EXPECT_EQ(refusal("name = \"X\"\nlike = 3\n"),
            "like in R/modules/x.toml:2 (a number where text is expected) name a part, as like = "
            "\"TSOP94256\"");
  write("modules/y.toml", "name = \"Y\"\nlike = \"X\"\n");
  EXPECT_EQ(
      refusal("name = \"X\"\nlike = \"Y\"\n"),
      "like = \"X\" in R/modules/y.toml:2 (parts that are like each other in a circle have no "
      "numbers) give one of them its own");
}

TEST_F(Parts, RefusesCurvesOfNoShape) {
  const auto curve = [&](const std::string& x, const std::string& y) {
    return refusal(least + "[directivity]\nsource = \"s\"\ndegrees = " + x +
                   "\nrelative_distance = " + y);
  };
  EXPECT_EQ(curve("[0, 90]", "[1, 0]"), "accepted");
  EXPECT_EQ(curve("[0, 45, 90]", "[1, 0]"),
            "directivity in R/modules/x.toml:10 (degrees has 3 values, relative_distance has 2) "
            "give both lists the same length");
  EXPECT_EQ(curve("[0]", "[1]"),
            "directivity in R/modules/x.toml:10 (a curve has at least two points) add points");
  EXPECT_EQ(curve("[0, 0]", "[1, 0]"),
            "directivity in R/modules/x.toml:10 (degrees must increase from point to point) sort "
            "the points");
  EXPECT_EQ(curve("[0, 91]", "[1, 0]"),
            "directivity.degrees = 91 in R/modules/x.toml:10 (angle off axis must be at most 90 "
            "degree) use a value 0 to 90");
  EXPECT_EQ(curve("[0, 90]", "[1, nan]").substr(0, 64),
            "directivity.relative_distance = nan in R/modules/x.toml:11 (not ");
}

// What others are taken relative to must not be 0: the light would be no number.
TEST_F(Parts, RefusesCurvesWithoutTheirReference) {
  const auto curve = [&](const std::string& table, const std::string& x, const std::string& y) {
    return refusal(least + "[" + table + "]\nsource = \"s\"\n" + x + "\n" + y);
  };
  EXPECT_EQ(curve("spectral", "nm = [900, 940, 950]", "relative_response = [1, 0, 1]"),
            "X in R/modules/x.toml (its spectral response is 0 at 940 nm, where Emin is taken) "
            "correct the part's file");
  EXPECT_EQ(curve("directivity", "degrees = [0, 90]", "relative_distance = [0, 1]"),
            "X in R/modules/x.toml (its directivity is 0 on axis, where Emin is taken) correct the "
            "part's file");
  EXPECT_EQ(
      curve("directivity_vertical", "degrees = [-90, 0, 90]", "relative_distance = [1, 0, 1]"),
      "X in R/modules/x.toml (its vertical directivity is 0 on axis, where Emin is taken) "
      "correct the part's file");
  EXPECT_EQ(refusal(least + "supply_min_v = { value = 3, source = \"s\" }\n"
                            "supply_max_v = { value = 2, source = \"s\" }\n"),
            "X in R/modules/x.toml (its largest supply voltage is below its least) correct the "
            "part's file");
  EXPECT_EQ(refusal(least + "emin_max_mw_per_m2 = { value = 0.001, source = \"s\" }\n"),
            "X in R/modules/x.toml (its emin_max_mw_per_m2 is below its emin_mw_per_m2) correct "
            "the part's "
            "file");
}

TEST_F(Parts, NameIsFoundWhateverItsCaseAndFirstRootWins) {
  write("modules/x.toml", least);
  EXPECT_EQ(module_of("x", {root_, scenarios}).centre_hz, 38000);
  EXPECT_EQ(module_of("tSoP4856", {root_, scenarios}).centre_hz, 56000);
  write("modules/tsop4856.toml", "name = \"TSOP4856\"" + least.substr(least.find('\n')));
  EXPECT_EQ(module_of("TSOP4856", {root_, scenarios}).centre_hz, 38000);
  EXPECT_EQ(module_of("TSOP4856", {scenarios, root_}).centre_hz, 56000);
}

TEST_F(Parts, UnknownNameNamesTheNearestAndWhereItWasSought) {
  EXPECT_EQ(answer("Y"),
            "asked (no module of this name in R/modules) add a file modules/NAME.toml");
  write("modules/tsop4856.toml", "");
  write("modules/irm.toml", "");
  EXPECT_EQ(answer("TSOP4857"),
            "asked (no module of this name in R/modules) did you mean tsop4856?");
  EXPECT_EQ(answer("BPW34"),
            "asked (no module of this name in R/modules) cosys-sim parts lists all that there are");
  write("leds/bpw34.toml", "");
  EXPECT_EQ(answer("BPW34"),
            "asked (BPW34 is the name of a part of the kind LED) name a part of the kind module: "
            "cosys-sim parts lists them");
  EXPECT_EQ(answer("../modules/irm").substr(0, 25), "asked (no module of this ");
}

TEST_F(Parts, ListNamesEachPartOnce) {
  write("modules/x.toml", "");
  const auto parts = sim::list_parts({scenarios, root_, scenarios});
  std::vector<std::string> names;
  for (const auto& part : parts) names.push_back(part.kind + " " + part.name);
  EXPECT_EQ(std::ranges::count(names, "LED tsal6200"), 1);
  EXPECT_EQ(std::ranges::count(names, "module tsop4856"), 1);
  EXPECT_EQ(std::ranges::count(names, "module x"), 1);
}

void load(const sim::PartFile& part) {
  const sim::PartSources from{{scenarios}, {}, {}};
  if (part.kind == "LED") return static_cast<void>(sim::load_led(part.name, from, ""));
  if (part.kind == "floor") return static_cast<void>(sim::load_floor(part.name, from, ""));
  if (part.kind == "module") return static_cast<void>(sim::load_module(part.name, from, ""));
  EXPECT_EQ(part.kind, "photodiode");
  sim::load_photodiode(part.name, from, "");
}

TEST(PartFacts, EveryPartOfTheProjectLoads) {
  for (const auto& part : sim::list_parts({scenarios})) {
    EXPECT_NO_THROW(load(part)) << part.path;
    EXPECT_EQ(part.name.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ"), std::string::npos);
  }
}

TEST(PartFacts, Tsop4856IsTheDefaultModule) {
  const auto module = module_of("TSOP4856", {scenarios});
  const std::set<std::string> printed{"emin_max_mw_per_m2", "supply_min_v", "supply_max_v"};
  for (const auto& field : sim::module_keys().numbers) {
    if (printed.contains(field.facts.name)) continue;  // of these no default can be right
    EXPECT_EQ(module.*field.member, channel::ModuleData{}.*field.member) << field.facts.name;
  }
}

// R17, Vishay 82459 rev 1.8 Fig. 11: response to irradiance is the square of the relative distance.
TEST(PartFacts, Tsop4856RespondsOffAxisAsFig11) {
  const auto curve = module_of("TSOP4856", {scenarios}).directivity;
  const double expected[][2] = {{0, 1}, {30, .499}, {45, .255}, {60, .118}, {80, .016}};
  for (const auto& [degrees, response] : expected)
    EXPECT_NEAR(curve(degrees) * curve(degrees), response, .01) << degrees;
}

// T1, Vishay 81010 rev 2.4 Fig. 5 and characteristics p. 2 (72 mW/sr typical at 100 mA).
TEST(PartFacts, Tsal6200ShinesAsFig5) {
  const auto led = led_of("TSAL6200", {scenarios});
  const double expected[][2] = {{10, 6.79}, {20, 14.3}, {50, 37.0}, {100, 72.3}, {400, 283}};
  for (const auto& [ma, mw_per_sr] : expected)
    EXPECT_NEAR(channel::axial_intensity(led, dsp::Amperes(ma / 1e3)).value * 1e3, mw_per_sr,
                .005 * mw_per_sr);
}

// T2, Vishay 81010 rev 2.4 Fig. 9: half intensity near 17 degrees, and a skirt that no cosine power
// has.
TEST(PartFacts, Tsal6200SpreadsAsFig9) {
  const auto led = led_of("TSAL6200", {scenarios});
  const double expected[][2] = {{0, 1},     {17, .51},  {25, .21}, {40, .063},
                                {50, .046}, {60, .032}, {80, .01}, {90, 0}};
  for (const auto& [degrees, intensity] : expected)
    EXPECT_NEAR(channel::relative_intensity(led, dsp::degrees(degrees)), intensity,
                std::max(.001, .03 * intensity))
        << degrees;
}

}  // namespace
