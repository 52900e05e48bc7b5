// What is said of a measured module: in words, as JSON, and as a page with the recording beside the
// fit.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "occurrences.hpp"
#include "page_tables.hpp"
#include "sim/fit/fit_report.hpp"

namespace sim {
namespace {

MeasuredModule made_up_measurement() {
  MeasuredModule measured;
  measured.like.name = "TSOP4856";
  measured.captures = {
      {.file = "c<1>.csv", .wire = "rx", .plan_words = "the plan plan.txt", .steps = 3}};
  FittedModule& fit = measured.fit;
  fit.numbers = {
      {.key = "agc_attack_db_per_ms",
       .value = 0.17234,
       .low = 0.15811,
       .high = 0.18749,
       .is_told = true,
       .more = ""},
      {.key = "q", .value = 10.04, .low = 5.1, .high = 15.2, .is_told = true, .more = "x"},
      {.key = "agc_range_db", .value = 120, .low = 50, .high = 120, .more = "a carrier"}};
  fit.steps = {{0, 0, 0, 5, 4, 2, "light: pulses", "1"},
               {0, 1, -8, 3, 4, -1, "light: pulses", "1"},
               {0, 2, -8, 12, 12, 0, "time until it lets go", "ms"}};
  fit.usual_deviation = 1.29;
  fit.captures = {{.start_s = 0.1, .fitted_steps = 3}};
  fit.strongest_over_emin_db = 54.2;
  return measured;
}

TEST(FitWords, HaveALineForEachConstant) {
  const std::string text = measured_text(made_up_measurement());
  EXPECT_TRUE(
      text.starts_with("constant              value     95 % interval   unit   TSOP4856\n"
                       "agc_attack_db_per_ms  0.172     [0.158, 0.188]  dB/ms  0.3\n"
                       "q                     10.0      [5.1, 15.2]            10\n"
                       "agc_range_db          not told                  dB     120\n"))
      << text;
}

TEST(FitWords, SayWhatTheNumbersDoNot) {
  MeasuredModule measured = made_up_measurement();
  EXPECT_TRUE(measured_text(measured).ends_with(
      "Read rx of c<1>.csv, by the plan plan.txt: 3 steps of light.\n"
      "The plan begins at 0.1 s of the recording, and their clocks agree.\n"
      "Emin is that of TSOP4856, as the irradiance of the plan's first step is not known: measure "
      "it, and say --irradiance.\n"
      "The strongest light was 54 dB above Emin: of stronger light nothing is told.\n"
      "q is told, but not well: what would tell it better is x.\n"
      "agc_range_db is not told: what would tell it is a carrier.\n"
      "2 of 3 constants are told.\n"
      "The part follows the rule of the model: 3 numbers of the recording differ from the fit by "
      "1.29 standard deviations on the whole; 0.2 to 0.8 is usual.\n"))
      << measured_text(measured);
  measured.fit.numbers.push_back({.key = "ambient_k", .more = "a carrier"});
  EXPECT_EQ(occurrences(measured_text(measured),
                        "agc_range_db and ambient_k are not told: what would tell them is a "
                        "carrier.\n"),
            1U);
  measured.first_level_by = "--irradiance";
  measured.first_level_mw_per_m2 = 30.5;
  measured.fit.captures[0].clock_error = -0.0021;
  measured.fit.not_apart = {"a and b: c would"};
  measured.fit.misfits = {{"short bursts", "reported 20 ms later"}};
  const std::string text = measured_text(measured);
  for (const char* line :
       {"Emin is for 30.5 mW/m2 at the module in the plan's first step, as "
        "--irradiance says, and is wrong by as much as that: a TSAL6200 gives 0.55 to 2.8 times "
        "what a typical one does.\n",
        "of the recording, whose clock runs 0.210 % too slow.\n",
        "Not told apart: a and b: c would.\n",
        "The part does not follow the rule of the model, so do not rely on what run makes of it:\n"
        "- short bursts: reported 20 ms later.\n"
        "A plan that was not the one played, ",
        "In all, 3 numbers of the recording differ"})
    EXPECT_EQ(occurrences(text, line), 1U) << line << text;
  measured.fit.output_width = {-5.24, 2.31};
  EXPECT_EQ(occurrences(measured_text(measured),
                        "The output of a short burst at rest lasts -5.2 to +2.3 cycles more than "
                        "the burst.\n"),
            1U);
  measured.is_first_level_measured = true;
  measured.fit.strongest_over_emin_db = std::nullopt;
  EXPECT_EQ(occurrences(measured_text(measured), "wrong by as much as that.\n"), 1U);
  EXPECT_EQ(occurrences(measured_text(measured), "The strongest light"), 0U) << "Emin is not told";
  EXPECT_TRUE(nlohmann::json::parse(measured_json(measured))["strongest_over_emin_db"].is_null());
  EXPECT_EQ(nlohmann::json::parse(measured_json(measured))["output_width_cycles"]["most"], 2.31);
}

// The part may follow the rule on the whole, and a few of its steps not.
TEST(FitWords, CountWhatIsFarOffByItself) {
  MeasuredModule measured = made_up_measurement();
  EXPECT_EQ(occurrences(measured_text(measured), "standard deviations off"), 0U);
  measured.fit.steps[0].deviation = -8.1;
  measured.fit.steps[1].deviation = 8;
  measured.fit.steps[2].deviation = 900;
  EXPECT_EQ(occurrences(measured_text(measured),
                        "More than 8 standard deviations off are 1 of light and 1 of time until it "
                        "lets go. A few are usual"),
            1U)
      << measured_text(measured);
}

// Noise decides where a train is just held: of a misfit of such a part, that is the likely reason.
TEST(FitWords, DoubtAMisfitOfAPartWithoutMargin) {
  MeasuredModule measured = made_up_measurement();
  measured.fit.numbers.push_back({.key = "agc_margin_db", .value = 0.2});
  const char* reason = "With a margin of 0.2 dB, noise decides";
  EXPECT_EQ(occurrences(measured_text(measured), reason), 0U);
  measured.fit.misfits = {{"trains", "5 of 40 steps"}};
  EXPECT_EQ(occurrences(measured_text(measured), reason), 1U);
  measured.fit.numbers.back().value = 3;
  EXPECT_EQ(occurrences(measured_text(measured), "noise decides"), 0U);
}

TEST(FitWords, SayOfFurtherCapturesHowStrongTheirLightIs) {
  MeasuredModule measured = made_up_measurement();
  measured.captures.push_back(measured.captures[0]);
  measured.captures.push_back(measured.captures[0]);
  measured.captures[1].file = "near.csv";
  measured.captures[1].is_of_known_level = false;
  measured.captures[2].file = "lamp.csv";
  measured.captures[2].ambient_w_per_m2 = 10;
  measured.captures[2].lost_pairs = 12;
  measured.fit.captures = {
      {.start_s = 0.1, .fitted_steps = 3},
      {.start_s = 0.2, .level_db = 24.123, .fitted_steps = 2},
      {.start_s = 0.3, .level_db = -12.4, .fitted_steps = 1, .is_cut_short = true}};
  measured.first_level_mw_per_m2 = 60;
  measured.first_level_by = "--irradiance";
  measured.fit.strongest_db = 24.123;
  const std::string text = measured_text(measured);
  for (const char* line :
       {"Read rx of near.csv, by the plan plan.txt: the first 2 of 3 steps of light, as the others "
        "tell nothing more.\n"
        "The plan begins at 0.2 s of the recording, and their clocks agree.\n"
        "Its light is 24.12 dB stronger than that of c<1>.csv, as the recording says.\n",
        "Read rx of lamp.csv, by the plan plan.txt: the first 1 of 3 steps of light, where the "
        "recording ends.\n",
        "The sketch left out 12 pairs of edges of lamp.csv: something else lights the module. "
        "Shade "
        "it, and record again.\n",
        "Under the lamp of 10 W/m2 its light seems 12.40 dB weaker than that of c<1>.csv.\n",
        "The strongest light was 54 dB above Emin, 964 mW/m2: of stronger light, which an LED of "
        "72 mW/sr gives nearer than 0.27 m, nothing is told.\n"})
    EXPECT_EQ(occurrences(text, line), 1U) << line << text;
  measured.fit.numbers.back().is_told = true;
  EXPECT_EQ(occurrences(measured_text(measured), "stronger light"), 0U) << "the range is told";
  const auto json = nlohmann::json::parse(measured_json(measured));
  EXPECT_EQ(json["captures"].size(), 3U);
  EXPECT_EQ(json["captures"][2]["ambient_w_per_m2"], 10);
}

TEST(FitWords, TellWhetherAnythingIsTold) {
  MeasuredModule measured = made_up_measurement();
  EXPECT_TRUE(tells_something(measured));
  for (FittedNumber& number : measured.fit.numbers) number.is_told = false;
  EXPECT_FALSE(tells_something(measured));
}

TEST(FitJson, HasTheNumbersAsTheyAre) {
  MeasuredModule measured = made_up_measurement();
  measured.fit.misfits = {{"short bursts", "later"}};
  const auto json = nlohmann::json::parse(measured_json(measured));
  EXPECT_EQ(json["numbers"][0],
            nlohmann::json::parse(R"({"name":"agc_attack_db_per_ms","value":0.17234,"low":0.15811,
                                      "high":0.18749,"unit":"dB/ms","is_told":true})"));
  EXPECT_EQ(json["numbers"][2]["would_tell"], "a carrier");
  EXPECT_EQ(json["steps"][1],
            nlohmann::json::parse(
                R"({"capture":0,"step":1,"level_db":-8.0,"quantity":"light: pulses","unit":"1",
                                      "recorded":3.0,"fitted":4.0,"deviation":-1.0})"));
  EXPECT_EQ(json["misfits"][0]["what"], "short bursts");
  EXPECT_FALSE(json.contains("first_level"));
}

TEST(FitPage, HasAChartForEachQuantityAndTheResidualsOfAll) {
  const Page page = measured_page(made_up_measurement());
  EXPECT_TRUE(page.summary.starts_with("2 of 3 constants are told.\n")) << "the answer first";
  std::vector<std::string> headings;
  for (const PageSection& section : page.sections) headings.push_back(section.heading);
  EXPECT_EQ(headings,
            (std::vector<std::string>{"Constants", "What the recording says, and what not",
                                      "Light: pulses", "Time until it lets go", "Residuals"}));
  const Chart& pulses = *page.sections[2].picture->live;
  EXPECT_EQ(pulses.x.label, "light over the first step's [dB]") << "they differ";
  EXPECT_EQ(pulses.y.label, "pulses") << "the kind of light is in the heading";
  ASSERT_EQ(pulses.curves.size(), 2U);
  EXPECT_EQ(pulses.curves[0].name, "recorded");
  const ChartPoint& weak = pulses.curves[0].points[0];
  EXPECT_EQ(weak.x, -8);
  EXPECT_EQ(weak.y, 3);
  EXPECT_DOUBLE_EQ(weak.low, 3 - 1.96) << "one standard deviation is 1";
  EXPECT_DOUBLE_EQ(pulses.curves[0].points[1].high, 5 + 1.96 / 2);
  EXPECT_EQ(pulses.curves[1].points[1].y, 4);
  const Chart& times = *page.sections[3].picture->live;
  EXPECT_TRUE(times.x.label.starts_with("fitted time until it lets go")) << "all are of one level";
  EXPECT_EQ(times.curves[0].points[0].x, times.curves[1].points[0].y);
  const std::vector<ChartPoint>& residuals = page.sections[4].picture->live->curves[0].points;
  ASSERT_EQ(residuals.size(), 3U);
  EXPECT_EQ(residuals[0].x, 0) << "in the order of the plan";
  EXPECT_EQ(residuals[0].y, 2);
}

TEST(FitPage, HasACurveForEachCarrierAndSharesThatAreShares) {
  MeasuredModule measured = made_up_measurement();
  measured.fit.steps = {{.recorded = 100,
                         .fitted = 99,
                         .deviation = 1,
                         .quantity = "bursts",
                         .unit = "%",
                         .carrier_hz = 53e3},
                        {.recorded = 1,
                         .fitted = 2,
                         .deviation = -1,
                         .quantity = "bursts",
                         .unit = "%",
                         .carrier_hz = 56e3}};
  const Page page = measured_page(measured);
  const Chart& bursts = *page.sections[2].picture->live;
  ASSERT_EQ(bursts.curves.size(), 4U);
  EXPECT_EQ(bursts.curves[0].name, "recorded, 53.0 kHz");
  EXPECT_EQ(bursts.curves[3].name, "fitted, 56.0 kHz");
  EXPECT_EQ(bursts.curves[0].points[0].high, 100);
  EXPECT_EQ(bursts.curves[2].points[0].low, 0);
}

TEST(FitPage, HasTheConstantsAndMisfitsAsTables) {
  MeasuredModule measured = made_up_measurement();
  measured.fit.misfits = {{"short bursts", "later"}};
  const std::string page = page_as_html(measured_page(measured));
  const auto constants = table_under(page, "Constants");
  ASSERT_EQ(constants.size(), 3U);
  EXPECT_EQ(constants[0].at("constant"), "agc_attack_db_per_ms");
  EXPECT_EQ(constants[0].at("95 % interval"), "[0.158, 0.188]");
  EXPECT_EQ(constants[2].at("value"), "not told");
  const auto misfits = table_under(page, "Where the part does not follow the rule");
  ASSERT_EQ(misfits.size(), 1U);
  EXPECT_EQ(misfits[0].at("by how much"), "later");
  EXPECT_EQ(occurrences(page, "c<1>"), 0U);
  EXPECT_GE(occurrences(page, "c&lt;1&gt;.csv: a module like TSOP4856"), 2U);
}

}  // namespace
}  // namespace sim
