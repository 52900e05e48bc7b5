// Bars of shares and heat maps, and the tables below them.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "occurrences.hpp"
#include "sim/picture/reach_bars.hpp"
#include "sim/section/picture_sections.hpp"

namespace sim {
namespace {

TEST(ShareBars, OfShareAloneHaveATableInPercent) {
  const PageSection section = shares_section("bars", {.title = "t",
                                                      .description = "d",
                                                      .rows_label = "x",
                                                      .are_shares = true,
                                                      .kinds = {"a", "b"},
                                                      .rows = {{"one", {2, 1}}, {"none", {0, 0}}}});
  EXPECT_EQ(section.table->head, (std::vector<std::string>{"x", "a [%]", "b [%]"}));
  EXPECT_EQ(section.table->rows,
            (std::vector<std::vector<std::string>>{{"one", "66.7", "33.3"}, {"none", "-", "-"}}));
}

TEST(ShareBars, AreAsWideAsTheirShares) {
  const std::string svg = share_bars_as_svg({.title = "t",
                                             .description = "d",
                                             .rows_label = "x",
                                             .kinds = {"a", "b", "c"},
                                             .rows = {{"one", {3, 0, 1}}, {"none", {0, 0, 0}}}});
  EXPECT_EQ(occurrences(svg, "class=\"frame\""), 2U);
  EXPECT_EQ(occurrences(svg, "<rect class=\"fill0\" x=\"170.00\" y=\"60.00\" width=\"397.50\""),
            1U);
  EXPECT_EQ(occurrences(svg, "<rect class=\"fill2\" x=\"567.50\" y=\"60.00\" width=\"132.50\""),
            1U);
  EXPECT_EQ(occurrences(svg, "class=\"fill1\""), 1U) << "in the legend";
}

TEST(ShareBars, BeginBehindTheLongestLabel) {
  const std::string svg =
      share_bars_as_svg({.title = "t",
                         .description = "d",
                         .rows_label = "x",
                         .kinds = {"a"},
                         .rows = {{"ideal-noncoherent, TSAL6200, 2.15", {1}}, {"short", {1}}}});
  EXPECT_EQ(occurrences(svg, "<rect class=\"fill0\" x=\"242.50\""), 3U)
      << "33 letters; two bars and the legend\n"
      << svg;
  EXPECT_EQ(occurrences(svg, "viewBox=\"0 0 792.5"), 1U) << svg.substr(0, 400);
}

ReachBars reach_of(std::vector<ReachBar> bars) {
  return {
      .title = "t", .description = "d", .axis = "x", .from = 0, .to = 10, .bars = std::move(bars)};
}

// 400 pixels for 10, behind a margin of 20, 8 beside a label, and 6.5 a letter.
TEST(ReachBars, EndWhereLinksDo) {
  const std::string svg = reach_bars_as_svg(
      reach_of({{"ab", "2.5", 2.5, 2, 3, std::pair{1.0, 5.0}}, {"c", "0", -HUGE_VAL, 0, 0}}));
  EXPECT_EQ(occurrences(svg, "<rect class=\"fill1\" x=\"41.00\" y=\"48.00\" width=\"100.00\""), 1U);
  EXPECT_EQ(occurrences(svg, "class=\"fill1\""), 1U) << "none of one that does not reach";
  EXPECT_EQ(occurrences(svg, "<rect class=\"fill0\" x=\"81.00\" y=\"44.00\" width=\"160.00\""), 1U);
  EXPECT_EQ(occurrences(svg, "x1=\"121.00\" y1=\"52.00\" x2=\"161.00\" y2=\"52.00\""), 1U);
  EXPECT_EQ(occurrences(svg, "8 of 10 units"), 1U);
}

TEST(ReachBars, GoNoFurtherThanTheSweep) {
  const std::string svg = reach_bars_as_svg(
      reach_of({{"", "more than 10", HUGE_VAL, HUGE_VAL, HUGE_VAL}, {"", "9", 9, 8, HUGE_VAL}}));
  EXPECT_EQ(occurrences(svg, "<rect class=\"fill1\" x=\"28.00\" y=\"48.00\" width=\"400.00\""), 1U);
  EXPECT_EQ(occurrences(svg, "x1=\"348.00\" y1=\"76.00\" x2=\"428.00\""), 1U) << "the interval";
  EXPECT_EQ(occurrences(svg, "8 of 10 units"), 0U);
}

HeatMap map_of(const std::vector<std::string>& rows,
               const std::vector<std::vector<double>>& values) {
  return {.title = "t",
          .description = "d",
          .x_label = "x",
          .y_label = "y",
          .columns = {"1", "2"},
          .rows = rows,
          .values = values};
}

TEST(HeatMap, ColoursCellsByTheirDecadeAndDrawsWhereItPassesOnePercent) {
  const double unknown = std::nan("");
  const std::string svg = heat_map_as_svg(map_of({"low", "high"}, {{0, 0.5}, {0.005, unknown}}));
  for (const char* style : {"heat0", "heat2", "heat6"})
    EXPECT_EQ(occurrences(svg, "class=\"" + std::string(style) + "\""), 2U) << "cell and legend";
  EXPECT_EQ(occurrences(svg, "class=\"heat5\""), 1U);
  EXPECT_EQ(occurrences(svg, "class=\"frame\""), 1U) << "nothing is known";
  EXPECT_NE(svg.find("<path class=\"contour\" d=\"M340.00 76.00v26\"/>"), std::string::npos)
      << "between 0 and 0.5 alone\n"
      << svg;
}

TEST(HeatMap, PassesOnePercentBehindIt) {
  HeatMap map = map_of({"low"}, {{0.01, 0.02}});
  const std::string svg = heat_map_as_svg(map);
  EXPECT_EQ(occurrences(svg, "class=\"heat2\""), 2U) << "to 1 %: cell and legend";
  EXPECT_EQ(occurrences(svg, "class=\"contour\""), 2U) << "between them, and in the legend";
  map.has_contour = false;
  EXPECT_EQ(occurrences(heat_map_as_svg(map), "class=\"contour\""), 0U);
}

TEST(HeatMap, HasATableFromAboveAsThePicture) {
  const PageSection section =
      map_section("map", map_of({"low", "high"}, {{0, 0.5}, {0.005, std::nan("")}}));
  EXPECT_EQ(section.table->head, (std::vector<std::string>{"y \\ x", "1", "2"}));
  EXPECT_EQ(section.table->rows,
            (std::vector<std::vector<std::string>>{{"high", "0.005", "-"}, {"low", "0", "0.5"}}));
}

TEST(HeatMap, HasItsTextsInItsTable) {
  HeatMap map = map_of({"low"}, {{0, 0.5}});
  map.texts = {{"< 0.2", "0.5 [0.3, 0.7]"}};
  const PageSection section = map_section("map", map);
  EXPECT_EQ(section.table->rows[0], (std::vector<std::string>{"low", "< 0.2", "0.5 [0.3, 0.7]"}));
}

TEST(HeatMap, ColoursWhatIsNoRatioAsMuch) {
  const std::string svg = heat_map_as_svg(map_of({"all"}, {{2, 1e300}}));
  EXPECT_EQ(occurrences(svg, "class=\"heat7\""), 3U) << "cells and legend";
}

}  // namespace
}  // namespace sim
