// What reports of location answer, and in whose words.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "experiment_report.hpp"

namespace sim {
namespace {

class ExperimentAnswer : public ExperimentReport {};

const std::string location = "experiment = \"location\"\n[location]\ntrials = 40\n";

TEST_F(ExperimentAnswer, OfLocationSaysHowOftenEachCameOut) {
  const Json counted = run("x", location + "[sweep]\nlocation.relative_sigma = [0.03, 0.3]\n");
  const Json& counts = counted["variables"]["n_outcomes"]["values"];
  const auto of = [&](std::size_t i) { return counts[i].get<int>() + counts[i + 5].get<int>(); };
  ASSERT_GT(of(1), 0);
  std::string text =
      fmt::format("<p>Locating was tried 80 times at 2 points: located {} times", of(0));
  const char* const words[] = {"ambiguous", "poor fit", "underdetermined", "did not converge"};
  for (std::size_t i = 1; i < 5; ++i)
    if (of(i) > 0) text += fmt::format(", {} {}", words[i - 1], of(i));
  const std::string page = report({"x.h5", "--svg", "p"});
  expect_has(page, text + ".</p>");
  const std::string outcomes = content(path("p/outcomes.svg"));
  for (const char* word : words) expect_has(outcomes, fmt::format(">{}</text>", word));
  expect_has(page, "<th scope=\"col\">did not converge</th>");
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

}  // namespace
}  // namespace sim
