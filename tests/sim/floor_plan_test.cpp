// Floors from above: to scale, and everybody in his place.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>
#include <string>
#include <vector>

#include "occurrences.hpp"
#include "sim/picture/floor_plan.hpp"

namespace sim {
namespace {

struct At {
  double x, y;
};

/// Where the paths of a style begin.
std::vector<At> begins(const std::string& svg, const std::string& style) {
  const std::regex path("<path class=\"" + style + "\" d=\"M(-?[0-9.]+) (-?[0-9.]+)");
  std::vector<At> all;
  for (std::sregex_iterator i(svg.begin(), svg.end(), path), end; i != end; ++i)
    all.push_back({std::stod((*i)[1]), std::stod((*i)[2])});
  return all;
}

/// Every point that a path of that style goes through.
std::vector<At> points(const std::string& svg, const std::string& style) {
  const std::regex whole("<path class=\"" + style + "\" d=\"([^\"]*)\"");
  const std::regex pair("[ML](-?[0-9.]+) (-?[0-9.]+)");
  std::vector<At> all;
  for (std::sregex_iterator i(svg.begin(), svg.end(), whole), end; i != end; ++i) {
    const std::string data = (*i)[1];
    for (std::sregex_iterator k(data.begin(), data.end(), pair); k != end; ++k)
      all.push_back({std::stod((*k)[1]), std::stod((*k)[2])});
  }
  return all;
}

constexpr double disc_radius = 3;  // a disc begins at its left

PlanMark device_mark(double x, double y, std::size_t colour = 0) {
  return {.at = {x, y}, .colour = colour};
}

TEST(FloorPlan, HasOneScaleAlongBothAxes) {
  for (const double size : {0.1, 1.0, 40.0}) {
    const std::string svg =
        floor_plan_as_svg({.title = "t",
                           .description = "d",
                           .devices = {device_mark(0, 0), device_mark(size, 0),
                                       device_mark(0, size / 2), device_mark(-size, 0)}});
    const std::vector<At> at = begins(svg, "curve1 disc");
    ASSERT_EQ(at.size(), 4U);
    EXPECT_GT(at[1].x - at[0].x, 100) << "uses its room";
    EXPECT_NEAR(at[0].y - at[2].y, (at[1].x - at[0].x) / 2, 0.02) << "y goes up, as far as x";
    EXPECT_NEAR(at[0].x - at[3].x, at[1].x - at[0].x, 0.02);
  }
}

TEST(FloorPlan, ShowsWhereDevicesAndReceiversLook) {
  const std::string svg = floor_plan_as_svg(
      {.title = "t",
       .description = "d",
       .devices = {{.at = {0, 0}, .heading = std::numbers::pi / 2, .is_solid = false}},
       .receivers = {{.at = {1, 0}, .heading = std::numbers::pi}}});
  const std::vector<At> line = points(svg, "curve1 dot");
  ASSERT_GE(line.size(), 2U);
  EXPECT_NEAR(line[1].x, line[0].x, 0.02);
  EXPECT_LT(line[1].y, line[0].y - 10) << "up";
  const std::vector<At> arrow = points(svg, "dot");
  ASSERT_EQ(arrow.size(), 3U);
  EXPECT_LT(arrow[0].x, arrow[1].x - 10) << "its tip is to the left";
  EXPECT_EQ(occurrences(svg, " disc\""), 0U) << "nothing was heard of it: a ring";
}

TEST(FloorPlan, PutsKindsOfDotsOnTracksBesideTheWay) {
  const PlanDots::Dot there{{0.5, 0}, 0};
  const std::string svg =
      floor_plan_as_svg({.title = "t",
                         .description = "d",
                         .way = {{0, 0}, {1, 0}},
                         .dots = {{"left", {there, there}, 0}, {"right", {there}, 3}}});
  const double way = points(svg, "way").at(0).y;
  const std::vector<At> left = points(svg, "curve1 dot"), right = points(svg, "curve4 dot");
  ASSERT_EQ(left.size(), 2U) << "two in one place are one; and that of the legend";
  EXPECT_LT(left[0].y, way);
  EXPECT_GT(right[0].y, way);
  EXPECT_NEAR(way - left[0].y, right[0].y - way, 0.02);
  EXPECT_NE(svg.find(">left</text>"), std::string::npos);
}

TEST(FloorPlan, LeavesDotsThatHaveAnEllipseInTheirPlace) {
  const std::string svg = floor_plan_as_svg(
      {.title = "t",
       .description = "d",
       .devices = {{.at = {0.5, 0}, .colour = {}}},
       .dots = {{"one", {{{0.5, 0}}}, 0, true}, {"seven", {{{0.5, 0}}}, 6, true}}});
  const std::vector<At> device_at = begins(svg, "disc");
  ASSERT_EQ(device_at.size(), 1U) << "in the colour of texts";
  for (const char* style : {"curve1 dot", "curve7 dot"}) {
    const std::vector<At> at = begins(svg, style);
    ASSERT_EQ(at.size(), 2U) << "and that of the legend";
    EXPECT_EQ(at[0].y, device_at[0].y);
  }
}

TEST(FloorPlan, DrawsEllipsesOfTheirSizeAndDirection) {
  const double tilt = std::numbers::pi / 6;
  const std::string svg =
      floor_plan_as_svg({.title = "t",
                         .description = "d",
                         .devices = {device_mark(0, 0, 1), device_mark(4, 0, 1)},
                         .ellipses = {{{2, 0}, 1, 0.25, tilt, 0}, {{2, 0}, 5, 1, 0, 2}}});
  const std::vector<At> at = begins(svg, "curve2 disc");
  const double metre = (at[1].x - at[0].x) / 4;
  const At centre{at[0].x + disc_radius + 2 * metre, at[0].y};
  double longest = 0, shortest = 1e9;
  At tip{};
  for (const At& p : points(svg, "curve1")) {
    const double away = std::hypot(p.x - centre.x, p.y - centre.y);
    if (away > longest) longest = away, tip = p;
    shortest = std::min(shortest, away);
  }
  EXPECT_NEAR(longest, metre, 0.05);
  EXPECT_NEAR(shortest, 0.25 * metre, 0.05);
  EXPECT_NEAR(std::abs((centre.y - tip.y) / (tip.x - centre.x)), std::tan(tilt), 0.01);
  EXPECT_GT((centre.y - tip.y) * (tip.x - centre.x), 0) << "turned to the left, not to the right";
  EXPECT_TRUE(points(svg, "curve3").empty()) << "larger than the floor";
}

TEST(FloorPlan, LabelsTheAxesInRoundMetres) {
  const std::string svg = floor_plan_as_svg(
      {.title = "t", .description = "d", .devices = {device_mark(-1, -1), device_mark(1, 1)}});
  for (const char* label : {">-1</text>", ">0</text>", ">1</text>", ">x [m]</text>"})
    EXPECT_NE(svg.find(label), std::string::npos) << label;
  EXPECT_EQ(svg.find(">-0</text>"), std::string::npos);
}

TEST(FloorPlan, StandsWithoutAnybody) {
  for (const FloorPlan& plan :
       {FloorPlan{"t", "d"},
        FloorPlan{.title = "t", .description = "d", .devices = {device_mark(5, 5)}},
        FloorPlan{.title = "t", .description = "d", .devices = {device_mark(std::nan(""), 0)}}}) {
    const std::string svg = floor_plan_as_svg(plan);
    EXPECT_NE(svg.find("class=\"floor\""), std::string::npos);
    for (const char* number : {"inf", "nan"}) EXPECT_EQ(svg.find(number), std::string::npos);
  }
}

}  // namespace
}  // namespace sim
