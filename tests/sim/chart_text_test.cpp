// Charts in a terminal: marks, levels, legends.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "occurrences.hpp"
#include "one_curve.hpp"

namespace sim {
namespace {

TEST(ChartText, MarksBothCurvesAndLeavesOutWhatIsNotKnown) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const std::string plot = chart_as_text(
      {.title = "",
       .description = "",
       .x = {"x [m]"},
       .y = {"y"},
       .curves = {{"a", {{0, 0}, {1, 5}, {2, 10}}}, {"b", {{0, 0}, {1, unknown}, {2, 20}}}}});
  EXPECT_EQ(occurrences(plot, "\n"), 18U);
  EXPECT_NE(plot.find("y; o a, x b, * both\n"), std::string::npos) << plot;
  EXPECT_NE(plot.find("        20 |" + std::string(63, ' ') + "x\n"), std::string::npos) << plot;
  EXPECT_NE(plot.find("         0 |*\n"), std::string::npos) << plot;
  EXPECT_NE(plot.find("|" + std::string(63, ' ') + "o\n"), std::string::npos) << plot;
  EXPECT_NE(plot.find("|" + std::string(32, ' ') + "o\n"), std::string::npos) << plot;
  EXPECT_NE(plot.find("+" + std::string(64, '-') + "\n"), std::string::npos) << plot;
}

TEST(ChartText, MarksLimitsAndLetsWhatWasMeasuredCoverTheory) {
  Chart chart = chart_of({{1, 0, 0, 1e-3, true}, {2, 0.1, 0.05, 0.2}}, true);
  chart.curves.push_back({"theory", {{1, 1e-4}, {2, 0.1}}, CurveKind::theory});
  const std::string plot = chart_as_text(chart);
  EXPECT_NE(plot.find("y, logarithmic; o c, . theory, v less than that\n"), std::string::npos)
      << plot;
  EXPECT_NE(plot.find("|" + std::string(63, ' ') + "o\n"), std::string::npos) << plot;
  EXPECT_NE(plot.find("|v\n"), std::string::npos) << plot;
  EXPECT_NE(plot.find("|.\n"), std::string::npos) << plot;
}

/// What stands left of the paper, from its top down, lines without a mark left out.
std::vector<std::string> upright_marks(const std::string& plot) {
  std::vector<std::string> marks;
  std::istringstream lines(plot);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t edge = line.find(" |"), first = line.find_first_not_of(' ');
    if (edge != std::string::npos && first < edge)
      marks.push_back(line.substr(first, edge - first));
  }
  return marks;
}

TEST(ChartText, MarksPowersOfTen) {
  using Marks = std::vector<std::string>;
  const auto marks_from = [](double least, double greatest) {
    return upright_marks(chart_as_text(
        chart_of({{1, least, least, least}, {2, greatest, greatest, greatest}}, true)));
  };
  EXPECT_EQ(marks_from(0.0059, 0.3996), (Marks{"1", "0.1", "0.01", "1e-3"}));
  EXPECT_EQ(marks_from(0.5, 0.5), (Marks{"1", "0.1"}));
  EXPECT_EQ(marks_from(0.001229, 0.001229), (Marks{"0.01", "1e-3"}));
  const Marks many = marks_from(1e-30, 1);
  EXPECT_EQ(many.front(), "1");
  EXPECT_GE(many.size(), 5U);
  for (const std::string& mark : many) EXPECT_TRUE(mark == "1" || mark.starts_with("1e-")) << mark;
  EXPECT_EQ(upright_marks(chart_as_text(chart_of({{1, 0.5, 0, 1}, {2, 3.25, 3, 4}}, false))),
            (Marks{"3.25", "0.5"}));
}

TEST(ChartText, DrawsItsLevelAcrossUnderAllElse) {
  Chart chart = chart_of({{1, 0, 0, 1.2e-3, true}, {2, 0.01, 0.01, 0.01}}, true);
  chart.y.level = 0.01;
  const std::string plot = chart_as_text(chart);
  EXPECT_EQ(upright_marks(plot), (std::vector<std::string>{"0.1", "0.01", "1e-3"}));
  EXPECT_NE(plot.find("      0.01 |- - - "), std::string::npos) << plot;
  EXPECT_NE(plot.find(" - -o 1 %\n"), std::string::npos) << plot;
  chart.y.level.reset();
  EXPECT_EQ(chart_as_text(chart).find("- - -"), std::string::npos);
}

TEST(ChartText, HasALegendNoWiderThanThePaper) {
  Chart chart = chart_of({{1, 1, 1, 1}}, false);
  for (int i = 0; i < 9; ++i) {
    chart.curves.front().name += "longer";
    chart.curves.push_back(chart.curves.front());
    std::istringstream lines(chart_as_text(chart));
    for (std::string line; std::getline(lines, line) && line.find('|') == std::string::npos;)
      EXPECT_LE(line.size(), 76U) << line;
  }
}

TEST(ChartText, TellsManyCurvesApartInALegendNoWiderThanThePaper) {
  Chart chart = chart_of({}, false);
  chart.curves.clear();
  for (int i = 0; i < 30; ++i)
    chart.curves.push_back({fmt::format("n{}", i), {{static_cast<double>(i), 1, 1, 1}}});
  const std::string plot = chart_as_text(chart);
  std::istringstream lines(plot);
  std::string legend, line;
  while (std::getline(lines, line) && line.find('|') == std::string::npos) {
    EXPECT_LE(line.size(), 76U) << line;
    legend += line;
  }
  std::set<char> marks;
  for (int i = 0; i < 30; ++i) {
    const std::size_t name = legend.find(fmt::format(" n{}{}", i, i < 29 ? "," : ""));
    ASSERT_NE(name, std::string::npos) << i;
    marks.insert(legend[name - 1]);
  }
  EXPECT_EQ(marks.size(), 30U);
}

}  // namespace
}  // namespace sim
