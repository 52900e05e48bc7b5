// Drawings read again, for gnuplot: how things look by the style sheet, paths, texts in quotes.
#include "sim/picture/gnuplot_script.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "occurrences.hpp"
#include "sim/picture/path_data.hpp"
#include "sim/picture/style_sheet.hpp"

namespace sim {
namespace {

constexpr const char* sheet =
    "\nsvg { background: #fed; color: #222; font: 12px sans-serif; }\n"
    "text { fill: currentColor; }\n"
    "line, path { stroke: currentColor; fill: none; stroke-width: 1.5; }\n"
    ".late { stroke: #ff0000; }\n"
    ".last { stroke: #00ff00; stroke-dasharray: 6 4; stroke-opacity: .25; }\n"
    ".middle, .wrong { text-anchor: middle; }\n"
    ".heading { font-size: 15px; font-weight: bold; }\n"
    ".wrong { font: bold 13px monospace; fill: #cc3311; }\n"
    ".character { font: 13px monospace; }\n"
    "@media (prefers-color-scheme: dark) { svg { color: #ddd; } .late { stroke: #111; } }\n";

TEST(StyleSheet, SaysWhatABrowserWouldShow) {
  const StyleSheet styles(sheet);
  EXPECT_EQ(styles.paper().rgb, 0xffeeddU);
  const SvgLook line = styles.look_of("line", "unknown");
  EXPECT_FALSE(line.fill);
  EXPECT_EQ(line.stroke->rgb, 0x222222U) << "of light paper";
  EXPECT_EQ(line.stroke->opacity, 1);
  EXPECT_EQ(line.stroke_width, 1.5);
  EXPECT_TRUE(line.dashes.empty());
  const SvgLook rectangle = styles.look_of("rect", "");
  EXPECT_EQ(rectangle.fill->rgb, 0U) << "as SVG has it";
  EXPECT_FALSE(rectangle.stroke);
}

TEST(StyleSheet, GivesTheLastWordToWhatStandsLastInTheSheet) {
  const StyleSheet styles(sheet);
  EXPECT_EQ(styles.look_of("path", "late").stroke->rgb, 0xff0000U) << "a class over an element";
  for (const char* classes : {"late last", "last late"}) {
    const SvgLook look = styles.look_of("path", classes);
    EXPECT_EQ(look.stroke->rgb, 0x00ff00U) << classes;
    EXPECT_EQ(look.stroke->opacity, 0.25);
    EXPECT_EQ(look.dashes, (std::vector<double>{6, 4}));
  }
}

TEST(StyleSheet, KnowsFontsAndAnchors) {
  const StyleSheet styles(sheet);
  const SvgLook plain = styles.look_of("text", "");
  EXPECT_EQ(plain.font_family, "sans-serif");
  EXPECT_EQ(plain.font_size, 12);
  EXPECT_EQ(plain.anchor, "start");
  EXPECT_FALSE(plain.is_bold);
  const SvgLook heading = styles.look_of("text", "heading");
  EXPECT_EQ(heading.font_family, "sans-serif");
  EXPECT_EQ(heading.font_size, 15);
  EXPECT_TRUE(heading.is_bold);
  const SvgLook wrong = styles.look_of("text", "wrong");
  EXPECT_EQ(wrong.font_family, "monospace");
  EXPECT_EQ(wrong.fill->rgb, 0xcc3311U);
  EXPECT_EQ(wrong.anchor, "middle");
  EXPECT_TRUE(wrong.is_bold);
  EXPECT_FALSE(styles.look_of("text", "heading character").is_bold) << "a font says all of it";
}

TEST(StyleSheet, PassesNothingOver) {
  for (const char* css :
       {"g path { fill: none; }", "path:hover { fill: none; }", "line { marker-end: none; }",
        "svg { font: italic bold 12px serif; }", "svg { font: large; }"})
    EXPECT_THROW(StyleSheet{css}, std::logic_error) << css;
  for (const char* css :
       {"line { stroke: red; }", "line { stroke: #12345; }", "line { stroke-width: thin; }",
        "line { font-size: 12pt; }", "line { stroke-dasharray: 6,4; }"})
    EXPECT_THROW(StyleSheet(css).look_of("line", ""), std::logic_error) << css;
}

void expect_lines(std::string_view data, const std::vector<Polyline>& expected) {
  const std::vector<Polyline> lines = polylines_of(data);
  ASSERT_EQ(lines.size(), expected.size()) << data;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    ASSERT_EQ(lines[i].size(), expected[i].size()) << data;
    for (std::size_t k = 0; k < lines[i].size(); ++k) {
      EXPECT_DOUBLE_EQ(lines[i][k].x, expected[i][k].x) << data << " point " << k;
      EXPECT_DOUBLE_EQ(lines[i][k].y, expected[i][k].y) << data << " point " << k;
    }
  }
}

TEST(PathData, GoesFromPointToPoint) {
  expect_lines("M1 2L3 4.5L-1e1 6", {{{1, 2}, {3, 4.5}, {-10, 6}}});
  expect_lines("M 1,2 3,4 m 1 1 1 1", {{{1, 2}, {3, 4}}, {{4, 5}, {5, 6}}});
  expect_lines("M0.00 10.00H20.00V0.00H50.00", {{{0, 10}, {20, 10}, {20, 0}, {50, 0}}});
  expect_lines("M1 1h8M5 1v24m-4 -4l4 4l4 -4",
               {{{1, 1}, {9, 1}}, {{5, 1}, {5, 25}}, {{1, 21}, {5, 25}, {9, 21}}});
  expect_lines("M1 1H4V5Zl2 2", {{{1, 1}, {4, 1}, {4, 5}, {1, 1}}, {{1, 1}, {3, 3}}});
  expect_lines("M1 1M2 2m3 3", {});
  expect_lines("", {});
}

Polyline one_line(std::string_view data) {
  const std::vector<Polyline> lines = polylines_of(data);
  EXPECT_EQ(lines.size(), 1U) << data;
  return lines.at(0);
}

TEST(PathData, GoesRoundADot) {
  double least = 20, most = 20;
  for (const SvgPoint& point : one_line("M10 20m-2.5 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0")) {
    EXPECT_NEAR(std::hypot(point.x - 10, point.y - 20), 2.5, 1e-9);
    least = std::min(least, point.y);
    most = std::max(most, point.y);
  }
  EXPECT_NEAR(least, 17.5, 0.02) << "one half above";
  EXPECT_NEAR(most, 22.5, 0.02) << "and one below";
}

// W3C SVG 1.1, 8.3.8: of the four arcs of one ellipse between two points the flags choose one.
TEST(PathData, GoesAlongTheArcThatTheFlagsChoose) {
  struct Chosen {
    const char* flags;
    double x, y;  // a place that the arc passes, and none of the others does
  };
  // Ellipses of radii 40 and 20 from (40, 0) to (0, 20): about (0, 0) and about (40, 20).
  const double far = 40 * std::sqrt(0.5), near = 20 * std::sqrt(0.5);
  for (const Chosen& chosen : {Chosen{"0 1", far, near}, Chosen{"0 0", 40 - far, 20 - near},
                               Chosen{"1 0", -far, -near}, Chosen{"1 1", 40 + far, 20 + near}}) {
    const std::string data = std::string("M40 0A40 20 0 ") + chosen.flags + " 0 20";
    double distance = 99;
    for (const SvgPoint& point : one_line(data))
      distance = std::min(distance, std::hypot(point.x - chosen.x, point.y - chosen.y));
    EXPECT_LT(distance, 2) << data;
  }
}

TEST(PathData, TiltsEllipsesAndStretchesThemWhereTheyMustBe) {
  // Radii 5 and 3, the longer one along (0.8, 0.6), about (10, 10).
  const Polyline tilted =
      one_line("M6 7a5 3 36.86989764584402 1 1 8 6a5 3 36.86989764584402 1 1 -8 -6");
  for (const SvgPoint& point : tilted) {
    const double x = point.x - 10, y = point.y - 10;
    EXPECT_NEAR(std::hypot((0.8 * x + 0.6 * y) / 5, (0.8 * y - 0.6 * x) / 3), 1, 1e-6);
  }
  for (const SvgPoint& point : one_line("M0 0a1 1 0 0 1 8 0"))
    EXPECT_NEAR(std::hypot(point.x - 4, point.y), 4, 1e-9) << "radius 4 at least";
  expect_lines("M1 1a0 5 0 0 1 8 0", {{{1, 1}, {9, 1}}});
  expect_lines("M1 1a5 5 0 0 1 0 0", {{{1, 1}, {1, 1}}});
}

TEST(PathData, PassesNothingOver) {
  for (const char* data :
       {"M0 0C1 1 2 2 3 3", "M0 0Q1 1 2 2", "M0 0L1", "M0 0L1 x", "M0 0Z1 1", "1 1", "M0 0Lnan 1"})
    EXPECT_THROW(polylines_of(data), std::logic_error) << data;
}

std::string script_of(const std::string& words) {
  SvgDrawing drawing(100, 60, words, words);
  drawing.text({10, 20}, words, "heading");
  return gnuplot_script({drawing.finished()}, PaperFormat::png);
}

TEST(GnuplotScript, SaysNothingThatGnuplotCouldObey) {
  const std::string harmless = script_of("x");
  for (const std::string words :
       {"\"; system(\"rm -r .\"); \"", "`rm -r .`", "@x", "'\n!rm -r .\n'", "\\", "#", "{/Bold x}",
        "$d0 << end\nend", "a\n\nplot x"}) {
    std::string script = script_of(words);
    EXPECT_EQ(occurrences(script, "\n"), occurrences(harmless, "\n")) << script;
    const std::size_t begin = script.find("set label \"") + 11;
    const std::size_t end = script.find("\" noenhanced at 10,");
    ASSERT_LT(end, script.size());
    for (const char c : script.substr(begin, end - begin))
      EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '\\') << script;
    script.replace(begin, end - begin, "x");
    EXPECT_EQ(script, harmless);
  }
}

// gnuplot takes digits behind an octal number as part of it.
TEST(GnuplotScript, LeavesNoDigitBehindANumber) {
  EXPECT_NE(script_of("a0.1").find("set label \"a\\060\\056\\061\" "), std::string::npos);
}

TEST(GnuplotScript, PassesNothingOver) {
  EXPECT_THROW(gnuplot_script({"<svg><style></style><circle r=\"1\"/></svg>"}, PaperFormat::png),
               std::logic_error);
}

}  // namespace
}  // namespace sim
