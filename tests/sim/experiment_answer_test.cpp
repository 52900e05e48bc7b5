// What reports of location, presence and listening answer, and in whose words.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "experiment_report.hpp"
#include "page_tables.hpp"
#include "sim/false_accepts/false_accept_section.hpp"
#include "sim/loading/load_scenario.hpp"

namespace sim {
namespace {

class ExperimentAnswer : public ExperimentReport {};

const std::string location = "experiment = \"location\"\n[location]\ntrials = 12\n";

std::string answer_of(const std::string& page) { return page.substr(0, page.find("<h2>")); }

TEST_F(ExperimentAnswer, OfLocationSaysHowOftenEachCameOut) {
  const Json counted = run("x", location + "[sweep]\nlocation.relative_sigma = [0.03, 0.3]\n");
  const Json& counts = counted["variables"]["n_outcomes"]["values"];
  const auto of = [&](std::size_t i) { return counts[i].get<int>() + counts[i + 5].get<int>(); };
  ASSERT_GT(of(1), 0);
  std::string text =
      fmt::format("<p>Locating was tried 24 times at 2 points: located {} times", of(0));
  const char* const words[] = {"ambiguous", "poor fit", "underdetermined", "did not converge"};
  for (std::size_t i = 1; i < 5; ++i)
    if (of(i) > 0) text += fmt::format(", {} {}", words[i - 1], of(i));
  const std::string page = report({"x.h5", "--svg", "p"});
  expect_has(page, text + ".</p>");
  const std::string outcomes = content(path("p/outcomes.svg"));
  for (const char* word : words) expect_has(outcomes, fmt::format(">{}</text>", word));
  expect_has(page, "<th scope=\"col\">did not converge</th>");
}

TEST_F(ExperimentAnswer, OfLocationCountsOneTime) {
  run("x", "experiment = \"location\"\nlocation.trials = 1\n");
  expect_has(report({"x.h5"}), "<p>Locating was tried 1 time: located 1 time.</p>");
}

TEST_F(ExperimentAnswer, OfLocationSaysTheTruthOfWhatWasCounted) {
  const Json counted = run("x", location);
  EXPECT_EQ(counted["variables"]["n_trials"]["long_name"], "times that locating was tried");
}

TEST_F(ExperimentAnswer, OfLocationNamesEllipsesLeftOutWhereSomeAre) {
  run("x", location + "[sweep]\nlocation.relative_sigma = [0.03, 0.1]\n");
  EXPECT_EQ(report({"x.h5"}).find("left out"), std::string::npos);
  run("y", location + "[sweep]\nlocation.relative_sigma = [0.03, 10]\n");
  expect_has(report({"y.h5"}),
             "<p>1 of 2 ellipses are left out: a half axis is longer than all "
             "the rest is wide.</p>");
}

TEST_F(ExperimentAnswer, OfLocationNamesPointsWithoutAnEllipse) {
  run("x",
      "experiment = \"location\"\nfloor.part = \"none\"\n[location]\ntrials = 4\nx_m = [0, 3]\n"
      "y_m = [0, 0]\nheading_deg = [90, 90]\ndevice_x_m = -1.5\n"
      "[sweep]\nlocation.device_y_m = [0, 2]\n");
  expect_has(report({"x.h5"}), "there is no ellipse, as the readings bound nothing.</p>");
}

TEST_F(ExperimentAnswer, OfSharedLinkSaysWhyInWords) {
  run("s",
      "experiment = \"sharedlink\"\n[receiver]\nmodule = \"TSSP4056\"\nrange_m = 12.5\n"
      "[exchange]\nduration_s = 10\nruns = 1\n");
  const std::string page = report({"s.h5"});
  expect_has(page, "refused: wrong checksum");
  EXPECT_EQ(page.find("refused: wrong_checksum"), std::string::npos);
}

TEST_F(ExperimentAnswer, OfPresenceAtOnePointSaysHowOften) {
  const Json counted = run("p",
                           "experiment = \"presence\"\n[receiver]\nrange_m = 100\n[presence]\n"
                           "trials = 50\nadc_bits = 16\nfalse_alarm = [0.1, 0.001]\n");
  const std::string page = report({"p.h5"});
  const std::string share = table_under(page, "Detections and false alarms").at(1).at("detected");
  ASSERT_NEAR(std::stod(share), counted["variables"]["p_detection"]["values"][1].get<double>(),
              0.01);
  expect_has(answer_of(page), "<p>With false_alarm = 0.001 the device is noticed in " + share +
                                  " of the windows.</p>");
}

TEST_F(ExperimentAnswer, OfPresenceAtOneRangeComparesDetectors) {
  run("p",
      "experiment = \"presence\"\n[receiver]\nrange_m = 100\n[presence]\ntrials = 50\n"
      "adc_bits = 16\n[sweep]\npresence.detector = [\"synchronous\", \"dc-difference\"]\n");
  expect_has(report({"p.h5"}),
             "<p>With false_alarm = 0.001 the device is noticed least at presence.detector = "
             "dc-difference: in ");
}

/// Of an hour of line with so many messages of a device.
std::string false_accept_answer(double hours, std::int64_t frames, std::int64_t undetected) {
  StoredDataset stored{parse_scenario("experiment = \"listening\"\nlistening.runs = 1\n", "x.toml",
                                      {}, {COSYS_SOURCE_DIR "/scenarios"}),
                       dataset_of({}, "c")};
  const auto add = [&](const std::string& name, auto value) {
    stored.data.variables.push_back({{name, "1", ""}, true, {}, std::vector{value}});
  };
  add("n_runs", std::int64_t{1});
  add("line_h", hours);
  add("n_frames", frames);
  add("n_frames_undetected", undetected);
  add("n_frames_false", std::int64_t{0});
  add("undetected_per_hour", static_cast<double>(undetected) / hours);
  add("undetected_per_hour_ci_low", 13.0);
  add("undetected_per_hour_ci_high", 32.0);
  add("false_per_hour", 0.0);
  add("false_per_hour_ci_low", 0.0);
  add("false_per_hour_ci_high", 3.7 / hours);
  return false_accept_section("x", stored).summary;
}

TEST(FalseAcceptAnswer, SaysHowOftenErrorsAreUndetectedWhereADeviceSends) {
  EXPECT_EQ(false_accept_answer(1, 0, 0),
            "1 hour of line was listened to; 0 messages were accepted though the device itself "
            "sent none.\n"
            "The rate of false accepts is < 3.7 an hour.\n");
  EXPECT_EQ(false_accept_answer(1, 900, 21),
            "1 hour of line was listened to; 0 messages were accepted though the device itself "
            "sent none, and "
            "21 though it sent another.\nThe rate of undetected errors is 21 [13, 32] an hour.\n"
            "The rate of false accepts is < 3.7 an hour.\n");
  EXPECT_EQ(false_accept_answer(0.5, 0, 0).find("0.5 hours of line were listened to;"), 0U);
}

}  // namespace
}  // namespace sim
