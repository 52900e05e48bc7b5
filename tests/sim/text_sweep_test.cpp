// Sweeps over parts and choices.
#include <algorithm>
#include <string>
#include <vector>

#include "scenarios.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/scenario/canonical_text.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/scenario/text_axis.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

using Texts = std::vector<std::string>;

Texts labels(const std::string& text, const Texts& set = {}) {
  return loaded(text, set).sweep.at(0).labels;
}

Scenario point(const LoadedScenario& from, std::size_t index) {
  return point_scenario(from, point_coordinates(from.sweep, index));
}

TEST(TextSweep, IsWrittenAsAListByFileAndSetAlike) {
  const Texts both{"TSOP4856", "TSOP38256"};
  EXPECT_EQ(labels("[sweep]\nreceiver.module = ['TSOP4856', 'TSOP38256']"), both);
  EXPECT_EQ(labels("[sweep]\nreceiver.module = 'TSOP4856, TSOP38256'"), both);
  EXPECT_EQ(labels("", {"receiver.module=TSOP4856,TSOP38256"}), both);
  EXPECT_EQ(labels("[sweep]\nreceiver.module = 'TSOP38256'"), (Texts{"TSOP38256"}));
  EXPECT_EQ(labels("", {"receiver.module=TSOP38256,"}), (Texts{"TSOP38256"}));
  EXPECT_EQ(labels("[sweep]\nuart.receiver = '*'"),
            (Texts{"atmega", "mid-bit", "software-serial", "edge-timing"}));
}

TEST(TextSweep, CallsPartsByTheirOwnNames) {
  EXPECT_EQ(labels("", {"receiver.module=tsop4856,Tsop38256"}), (Texts{"TSOP4856", "TSOP38256"}));
}

TEST(TextSweep, ASingleTextOfSetReplacesIt) {
  const auto one =
      loaded("[sweep]\nreceiver.module = '*'\nled.yaw_deg = [1, 2]", {"receiver.module=TSOP38256"});
  ASSERT_EQ(one.sweep.size(), 1U);
  EXPECT_EQ(one.base.module.name, "TSOP38256");
}

TEST(TextSweep, EachPointIsTheScenarioOfItsTexts) {
  for (const std::string key : {"receiver.module", "led.part", "floor.part", "uart.receiver"}) {
    const auto swept = loaded("[sweep]\n" + key + " = '*'\nreceiver.range_m = [2, 3]");
    const Texts& texts = swept.sweep[0].labels;
    ASSERT_GE(texts.size(), 2U) << key;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const auto fixed = loaded("", {key + "=" + texts[i], "receiver.range_m=3"});
      EXPECT_EQ(canonical_text(point(swept, 2 * i + 1)), canonical_text(fixed.base))
          << key << " " << texts[i];
    }
  }
}

TEST(TextSweep, TextsOfTwoAxesMeet) {
  const auto swept =
      loaded("", {"led.part=TSAL6200,TSAL6400", "receiver.module=TSOP4856,TSOP38256"});
  const Scenario last = point(swept, 3), second = point(swept, 1);
  EXPECT_EQ(last.emitter.name + last.module.name, "TSAL6400TSOP38256");
  EXPECT_EQ(second.emitter.name + second.module.name, "TSAL6200TSOP38256");
  EXPECT_EQ(last.receiver.module, "TSOP38256");
}

TEST(TextSweep, NumbersOfTheScenarioHoldForEachPart) {
  const auto swept = loaded(
      "[module]\nq = 7\n[sweep]\nmodule.centre_hz = [55e3, 57e3]\n"
      "receiver.module = ['TSOP38256', 'TSOP4856']\n"
      "floor.part = ['none', 'tile']\nfloor.bump_height_mm = [1, 2]");
  for (std::size_t i = 0; i < 16; ++i) {
    const Scenario s = point(swept, i);
    EXPECT_EQ(s.module.q, 7);
    EXPECT_EQ(s.module.centre_hz, i < 8 ? 55e3 : 57e3);
    EXPECT_EQ(s.module.name, i / 4 % 2 == 0 ? "TSOP38256" : "TSOP4856");
    EXPECT_EQ(s.floor.name, i / 2 % 2 == 0 ? "none" : "tile");
    EXPECT_EQ(s.floor.bump_height_mm, i % 2 == 0 ? 1 : 2);
  }
}

TEST(TextSweep, AllPartsAreThoseToBeHad) {
  const Texts all = labels("[sweep]\nreceiver.module = '*'");
  EXPECT_NE(std::ranges::find(all, "TSOP4856"), all.end());
  EXPECT_NE(std::ranges::find(all, "TSOP38256"), all.end());
  EXPECT_EQ(std::ranges::find(all, "ideal-coherent"), all.end());
  const Texts more = labels("[sweep]\nreceiver.module = ['*', 'ideal-coherent']");
  EXPECT_EQ(more.size(), all.size() + 1);
}

// A part by two names is the same physics: neither text nor random numbers tell them apart.
TEST(TextSweep, CanonicalTextHasNoNamesOfParts) {
  const auto swept = loaded("[sweep]\nreceiver.module = '*'\nled.part = '*'\nfloor.part = '*'");
  const Scenario s = point(swept, 0);
  const std::string text = canonical_text(s);
  for (const std::string& name : {s.module.name, s.emitter.name, s.floor.name})
    EXPECT_EQ(text.find(name), std::string::npos) << name;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(TextSweep, TheKeptTextCarriesEveryPartOnceAndRepeatsTheRun) {
  const auto first = loaded("[sweep]\nreceiver.module = '*'\nled.part = 'TSAL6200,TSAL6400'");
  EXPECT_EQ(count(first.text, "[[part]]"), first.sweep[0].labels.size() + 2 + 1);  // and a floor
  const auto again = parse_scenario(first.text, "y.toml", {}, {});
  EXPECT_EQ(again.text, first.text);
  ASSERT_EQ(again.sweep.size(), 2U);
  EXPECT_EQ(again.sweep[0].labels, first.sweep[0].labels);
  for (std::size_t i = 0; i < count_points(first.sweep); ++i)
    EXPECT_EQ(canonical_text(point(again, i)), canonical_text(point(first, i))) << i;
}

/// An LED that no folder has, as a scenario carries it.
const std::string my_led =
    "[[part]]\n'leds/mine.toml' = '''\nname = \"mine\"\n"
    "half_angle_deg = { value = 20, source = \"s\" }\n"
    "[intensity]\nma = [1, 100]\nmw_per_sr = [1, 100]\nsource = \"s\"\n'''\n";

TEST(TextSweep, AllPartsAreCarriedOnesToo) {
  const Texts shipped = labels("[sweep]\nled.part = '*'");
  Texts more = labels("[sweep]\nled.part = '*'\n" + my_led);
  EXPECT_EQ(std::erase(more, "mine"), 1U);
  EXPECT_EQ(more, shipped);
}

// Elsewhere there may be more parts.
TEST(TextSweep, AllPartsOfAKeptTextStayTheOnesThatRan) {
  const auto first = loaded("[sweep]\nled.part = '*'");
  EXPECT_EQ(labels(first.text + my_led), first.sweep[0].labels);
}

TEST(TextSweep, IsRefusedInOneLineWithItsPlace) {
  const std::string how = " write a list, such as [\"A\", \"B\"] or A,B, or \"*\" for all";
  EXPECT_EQ(refusal("[sweep]\nled.part = []"), "led.part in x.toml:2 (an empty sweep)" + how);
  EXPECT_EQ(refusal("[sweep]\nled.part = ''"), "led.part in x.toml:2 (an empty sweep)" + how);
  EXPECT_EQ(refusal("[sweep]\nled.part = ['TSAL6200', '']"),
            "led.part = \"\" in x.toml:2 (an empty name)" + how);
  EXPECT_EQ(refusal("", {"led.part=,"}), "led.part = \"\" in --set (an empty name)" + how);
  EXPECT_EQ(refusal("\n[sweep]\nled.part = ['TSAL6200', 'tsal6200']"),
            "led.part = \"TSAL6200\" in x.toml:3 (twice in the same sweep) remove one of the two");
  EXPECT_EQ(refusal("", {"uart.receiver=mid-bit,*"}),
            "uart.receiver = \"mid-bit\" in --set (twice in the same sweep) remove one of the two");
  EXPECT_EQ(refusal("[sweep]\nled.part = ['TSAL6200', 'a,b']"),
            "led.part = \"a,b\" in x.toml:2 (a name with a comma cannot be swept) rename it");
  EXPECT_EQ(refusal("[receiver]\nmodule = '*'"),
            "receiver.module = \"*\" in x.toml:2 (all are a sweep) write it in [sweep]");
  const std::string unknown = refusal("[sweep]\nreceiver.module = ['TSOP4856', 'TSOP4857']");
  EXPECT_TRUE(
      unknown.starts_with("receiver.module = \"TSOP4857\" in x.toml:2 (no module of this "
                          "name in "))
      << unknown;
  EXPECT_TRUE(unknown.ends_with("did you mean tsop4856?")) << unknown;
}

// A comma in a name would split it when the list is read again.
TEST(TextSweep, AllPartsMustHaveNamesThatCanBeListed) {
  const std::string tile = read_text_file(COSYS_SOURCE_DIR "/scenarios/floors/tile.toml", "floor");
  std::string odd = tile;
  odd.replace(odd.find("\"tile\""), 6, "\"my,tile\"");
  EXPECT_EQ(refusal("[sweep]\nfloor.part = '*'\n[[part]]\n\"floors/my,tile.toml\" = '''\n" + odd +
                    "'''\n"),
            "floor.part = \"my,tile\" in x.toml:2 (a name with a comma cannot be swept) rename it");
}

TEST(TextSweep, AllOfNothingIsRefused) {
  try {
    parse_scenario("[sweep]\nled.part = '*'", "x.toml", {}, {});
    ADD_FAILURE() << "accepted";
  } catch (const Failure& failure) {
    EXPECT_STREQ(failure.what(),
                 "led.part = \"*\" in x.toml:2 (there is no part of this kind) add a file "
                 "leds/NAME.toml");
  }
}

TEST(TextSweep, EveryPointIsChecked) {
  EXPECT_EQ(refusal("led.temperature_c = 60", {"led.part=TSAL6200"}), "accepted");
  EXPECT_EQ(refusal("led.temperature_c = 60", {"led.part=TSAL6200,generic"}),
            "led.temperature_c = 60 in x.toml:1 (the data of generic hold for one temperature) use "
            "25");
}

}  // namespace
}  // namespace sim
