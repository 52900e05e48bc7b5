// `cosys-sim parts` from outside, and what it is made of: digitised curves and text plots.
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "scenarios.hpp"
#include "sim/components/digitised_curve.hpp"
#include "sim/components/parts.hpp"
#include "sim/report/part_sheet.hpp"
#include "sim/scenario/entries.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/text/text_file.hpp"

namespace {

using sim::scenarios;

namespace fs = std::filesystem;

class PartsCommand : public CommandLine {
 protected:
  /// A folder `mine` with an LED of two points, which claims a figure of three.
  void write_own_led(const std::string& figures, const std::string& curve) const {
    fs::create_directories(path("mine/leds"));
    fs::create_directories(path("mine/curves"));
    write("mine/leds/x.toml",
          "# A lamp of my own.\nname = \"X\"\nhalf_angle_deg = { value = 20, source = \"me\" }\n"
          "[intensity]\nma = [10, 100]\nmw_per_sr = [5, 50]\nsource = \"p. 2\"\n" +
              figures);
    write("mine/curves/c.csv", curve);
  }
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(PartsCommand, ListsEveryPartInALine) {
  const Outcome o = program({"parts"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out.substr(0, 10), "kind      ");
  EXPECT_EQ(o.out.find("(no such"), std::string::npos) << o.out;
  for (const char* line : {"module      TSOP4856 ", "module      GP1UX51QS ",
                           "LED         IR333-A ", "40 kHz, Emin 0.12 mW/m2, fixed gain\n",
                           "AGC: bursts beyond 24 cycles need gaps of 25 ms\n",
                           "72.3 mW/sr at 100 mA", "photodiode  BPW34 ",
                           "index 1, roughness 0 um, diffuse reflectance 0, metal reflectance 1\n",
                           "a duty of 0.098 at most, 20.5 cycles aside\n"})
    EXPECT_TRUE(has(o.out, line)) << line << o.out;
}

TEST_F(PartsCommand, SearchLooksIntoTheFiles) {
  const Outcome o = program({"parts", "--search", "agc5"});
  EXPECT_TRUE(has(o.out, "TSOP39556")) << o.out;
  EXPECT_FALSE(has(o.out, "TSOP4856")) << o.out;
  expect_refused({"parts", "--search", "valve"}, 2,
                 "--search valve (no part mentions it) leave it out to see all parts");
}

TEST_F(PartsCommand, UnknownNameNamesTheNearest) {
  expect_refused({"parts", "TSOP4857"}, 2,
                 "TSOP4857 (no part of this name) did you mean tsop4856?");
}

TEST_F(PartsCommand, ShowsNumbersWithSourcesAndTheModelBesideItsCurves) {
  write_own_led("[figures]\nintensity = \"c\"\n",
                "# Maker 1 Fig. 2, typical\nma,mw_per_sr\n10,5\n20,8\n100,50\n");
  const Outcome o = program({"parts", "x", "--parts", "mine"});
  EXPECT_EQ(o.code, 0) << o.err;
  for (const char* line :
       {"LED X: 940 nm, 50 mW/sr at 100 mA, half of it at 20 degrees\n", "  A lamp of my own.\n",
        "  half_angle_deg           20 degree      me\n",
        "  wavelength_nm            940 nm         (default: the file does not",
        "  intensity                2 points       p. 2\n", "  Maker 1 Fig. 2, typical\n",
        "            20            8           10        +25.0\n",
        "  rms deviation 14.4 %, median 0 %, over 3 of 3 points\n",
        "intensity [mW/sr], logarithmic; o data sheet, x model, * both\n"})
    EXPECT_TRUE(has(o.out, line)) << line << o.out;
}

// Of a quantity that is no share itself a deviation says little beside small values.
TEST(SheetComparison, HasItsMedianAsAShareToo) {
  sim::Comparison duty{.figure = {}, .sheet = {}, .model = {0.22, 0.38, 0.1}};
  duty.sheet.y = {0.2, 0.4, 0.4};
  EXPECT_NEAR(duty.median_deviation(), 0.02, 1e-12);
  EXPECT_NEAR(duty.median_share(), 0.1, 1e-12);
  duty.sheet.y[0] = 0;
  EXPECT_TRUE(std::isnan(duty.median_share())) << "of nothing there is no share";
}

TEST_F(PartsCommand, JsonHasTheSame) {
  write_own_led("[figures]\nintensity = \"c\"\n", "# Maker\nma,mw_per_sr\n10,5\n20,8\n100,50\n");
  const auto json = nlohmann::json::parse(program({"parts", "X", "--parts", "mine", "--json"}).out);
  EXPECT_EQ(json["numbers"]["half_angle_deg"]["source"], "me");
  EXPECT_TRUE(json["numbers"]["wavelength_nm"]["source"].is_null());
  EXPECT_NEAR(json["figures"][0]["model"][1], 10, 1e-9);
  EXPECT_NEAR(json["figures"][0]["rms_deviation"], 0.25 / std::sqrt(3), 1e-9);
  const auto list = nlohmann::json::parse(program({"parts", "--parts", "mine", "--json"}).out);
  EXPECT_GT(list.at("parts").size(), 20u);
}

TEST_F(PartsCommand, SaysWhyBoundsAreWhereTheFileIsSilent) {
  const Outcome o = program({"parts", "TSOP4456"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_TRUE(has(o.out,
                  "(default: the file does not say; bounds: least: Vishay's circuit "
                  "description of its modules; most: a strong carrier is suppressed)\n"))
      << o.out;
  for (const auto& number : sim::module_keys().numbers)
    EXPECT_TRUE(!number.unsaid || !number.unsaid->reason.empty()) << number.facts.name;
}

TEST_F(PartsCommand, RefusesFiguresThatAreNot) {
  write_own_led("[figures]\nspectral = \"c\"\n", "");
  expect_refused({"parts", "X", "--parts", "mine"}, 2,
                 "figures.spectral in mine/leds/x.toml:9 (no such key in a part file) did you mean "
                 "figures.pattern?");
  write_own_led("[figures]\nintensity = \"d\"\n", "");
  EXPECT_EQ(program({"parts", "X", "--parts", "mine"}).code, 2);
  write_own_led("[figures]\nintensity = \"../leds/x\"\n", "");
  expect_refused({"parts", "X", "--parts", "mine"}, 2,
                 "figures.intensity in mine/leds/x.toml:9 (not the bare name of a curve) name a "
                 "file in curves/ without its .csv");
  write_own_led("[figures]\nintensity = \"c\"\n", "# Maker\nma,mw_per_sr\n10,5\n20;8\n");
  expect_refused({"parts", "X", "--parts", "mine"}, 2,
                 "\"20;8\" in mine/curves/c.csv:4 (not two numbers) write X,Y");
}

TEST_F(PartsCommand, ABrokenPartDoesNotHideTheOthers) {
  fs::create_directories(path("mine/modules"));
  write("mine/modules/y.toml", "name = \"Y\"\nqq = 5\n");
  const Outcome o = program({"parts", "--parts", "mine"});
  EXPECT_EQ(o.code, 0);
  EXPECT_TRUE(has(o.out, "qq in mine/modules/y.toml:2 (no such key in a part file)")) << o.out;
  EXPECT_TRUE(has(o.out, "TSOP4856")) << o.out;
}

TEST(DigitisedCurves, EveryOneOfTheProjectIsReadAndNamesItsDocument) {
  int read = 0;
  for (const auto& file : fs::directory_iterator(scenarios / "curves")) {
    const auto curve = sim::read_digitised_curve(file.path());
    EXPECT_TRUE(has(curve.source, "Vishay 8") && has(curve.source, "Fig.")) << file.path();
    EXPECT_EQ(curve.x.size(), curve.y.size());
    ++read;
  }
  EXPECT_GE(read, 25);
}

// A curve that a file names but that is not there would be found only when that part is shown.
TEST(DigitisedCurves, EveryOneThatAPartNamesIsThere) {
  int named = 0;
  for (const auto& part : sim::list_parts({scenarios}))
    for (const auto& entry : sim::read_entries(sim::read_text_file(part.path, "part"), part.path)) {
      if (!entry.key.starts_with("figures.")) continue;
      const fs::path curve = std::get<std::string>(entry.value) + ".csv";
      EXPECT_TRUE(fs::exists(scenarios / "curves" / curve)) << entry.key << " " << entry.place;
      ++named;
    }
  EXPECT_GE(named, 25);
}

using Deviations = std::map<std::string, double>;  // by figure

/// As scenarios/README.md tells them: root mean squares, of the AGC's figures medians.
Deviations deviations(const std::string& name, const fs::path& folder = scenarios) {
  Deviations all;
  for (const auto& part : sim::list_parts({folder})) {
    if (part.name != name) continue;
    for (const auto& c : sim::read_part_sheet(part, {}, sim::Compare::yes).comparisons) {
      const bool of_agc = c.figure.name == "max_duty" || c.figure.name == "min_repetition";
      all[c.figure.name] = of_agc ? c.median_deviation() : c.rms_deviation();
    }
  }
  return all;
}

void expect_below(const Deviations& rms, const Deviations& most) {
  ASSERT_EQ(rms.size(), most.size());
  for (const auto& [figure, limit] : most) EXPECT_LT(rms.at(figure), limit) << figure;
}

// Vishay 82459 rev 1.8 Fig. 2, 4 to 7, 9 to 12: cycles, ms, and shares of the sheet's value.
TEST(ModelAgainstSheet, MeasuredTsop4856IsNearEveryCurveOfItsSheet) {
  expect_below(deviations("tsop4856"), {{"pulse_width", 0.81},
                                        {"on_time", 0.049},
                                        {"off_time", 0.052},
                                        {"frequency_response", 0.0035},
                                        {"ambient", 0.073},
                                        {"ripple", 0.022},
                                        {"ripple_10_khz", 0.027},
                                        {"ripple_100_khz", 0.028},
                                        {"max_duty", 0.027},
                                        {"temperature", 0.006},
                                        {"spectral", 0.004},
                                        {"directivity", 0.001},
                                        {"supply", 0.029}});
}

// Vishay 82491 rev 1.9, 82834 rev 1.2, 82836 rev 1.1.
TEST(ModelAgainstSheet, MeasuredOtherModulesAreNearTheirs) {
  expect_below(deviations("tsop38256"), {{"pulse_width", 1.72},
                                         {"ambient", 0.121},
                                         {"max_duty", 0.023},
                                         {"directivity", 0.006},
                                         {"directivity_vertical", 0.012}});
  expect_below(deviations("tsop94256"), {{"max_duty", 0.0126}});
  expect_below(deviations("tsop94456"), {{"max_duty", 0.0032}});
  expect_below(deviations("tsop94656"), {{"min_repetition", 0.24}});
}

// With no number from a curve of its own a part still comes near its curves: how near is told here,
// of a TSOP4856 in scenarios/README.md too. Vishay 82459 rev 1.8, 82491 rev 1.9, 82834 rev 1.2,
// 82836 rev 1.1, 81010 rev 2.4.
TEST(TablesAlone, MeasuredAPartComesNearItsCurvesWithoutThem) {
  const fs::path folder = fs::path(COSYS_SOURCE_DIR) / "tests/sim/tables_alone";
  expect_below(deviations("tsop4856", folder), {{"pulse_width", 1.2},
                                                {"on_time", 0.065},
                                                {"off_time", 0.055},
                                                {"frequency_response", 0.01},
                                                {"ambient", 0.15},
                                                {"ripple", 0.6},
                                                {"max_duty", 0.18},
                                                {"temperature", 0.15},
                                                {"spectral", 0.7},
                                                {"directivity", 0.04},
                                                {"supply", 0.4}});
  expect_below(
      deviations("tsop38256", folder),
      {{"pulse_width", 1.8}, {"ambient", 0.16}, {"max_duty", 0.085}, {"directivity", 0.15}});
  expect_below(deviations("tsop38456", folder), {{"max_duty", 0.064}});
  expect_below(deviations("tsop94256", folder), {{"max_duty", 0.03}});
  expect_below(deviations("tsop94456", folder), {{"max_duty", 0.0063}});
  expect_below(deviations("tsop94656", folder), {{"min_repetition", 1.84}});
  expect_below(deviations("tsal6200", folder),
               {{"intensity", 0.13}, {"temperature", 0.07}, {"pattern", 0.03}});
}

// Vishay 81010 rev 2.4 Fig. 5, 7, 9.
TEST(ModelAgainstSheet, MeasuredTsal6200IsNearEveryCurveOfItsSheet) {
  const auto rms = deviations("tsal6200");
  ASSERT_EQ(rms.size(), 3u);
  for (const auto& [figure, deviation] : rms) EXPECT_LT(deviation, 0.01) << figure;
}

}  // namespace
