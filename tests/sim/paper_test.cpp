// A report for print: whatever it holds, a few pages, and nothing beyond their edges.
#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <string>

#include "sim/page/paper.hpp"
#include "sim/picture/svg.hpp"

namespace sim {
namespace {

std::string drawing_of(double width, double height) {
  SvgDrawing drawing(width, height, "title", "description");
  drawing.rectangle({0, 0}, width, height, "frame");
  return drawing.finished();
}

PageSection picture_section(const std::string& heading, double width, double height) {
  return {.heading = heading, .picture = PagePicture{"name", "caption", drawing_of(width, height)}};
}

PageTable table_of(std::size_t rows, std::size_t columns) {
  PageTable table;
  table.head.assign(columns, "a column's head");
  table.rows.assign(rows, std::vector<std::string>(columns, "0.123 [0.1, 0.2]"));
  return table;
}

struct Corner {
  double x = 0, y = 0, scale = 1;
};

void expect_on_paper(pugi::xml_node drawing, const Corner& at) {
  for (const pugi::xml_node node : drawing.children()) {
    const std::string name = node.name();
    Corner inner = at;
    if (name == "g") {
      ASSERT_EQ(std::sscanf(node.attribute("transform").value(), "translate(%lf %lf) scale(%lf)",
                            &inner.x, &inner.y, &inner.scale),
                3);
      expect_on_paper(node, inner);
      continue;
    }
    if (name != "text" && name != "rect") continue;
    const double right = node.attribute("x").as_double() + node.attribute("width").as_double();
    const double below = node.attribute("y").as_double() + node.attribute("height").as_double();
    EXPECT_LE(at.x + at.scale * right, 794) << node.text().get();
    EXPECT_LE(at.y + at.scale * below, 1123) << node.text().get();
  }
}

void expect_pages(const Page& page, std::size_t least, std::size_t most) {
  const std::vector<std::string> pages = paper_pages(page);
  EXPECT_GE(pages.size(), least);
  EXPECT_LE(pages.size(), most);
  for (const std::string& one : pages) {
    pugi::xml_document document;
    ASSERT_TRUE(document.load_buffer(one.data(), one.size()));
    expect_on_paper(document.child("svg"), {});
  }
}

TEST(Paper, OfALittleIsOnePage) {
  expect_pages({.title = "t", .summary = "An answer.\n", .sections = {}}, 1, 1);
  expect_pages(
      {.title = "t",
       .summary = "An answer.\n",
       .sections = {picture_section("p", 700, 400), {.heading = "n", .table = table_of(3, 4)}}},
      1, 1);
}

TEST(Paper, OfMuchIsFourPagesAndSaysWhatIsLeftOut) {
  Page page{.title = "t", .summary = "", .sections = {}};
  for (int i = 0; i < 100; ++i) page.summary += "A sentence that tells of the answer. ";
  for (int i = 0; i < 20; ++i)
    page.sections.push_back(picture_section("picture " + std::to_string(i), 2000, 900));
  page.sections.push_back({.heading = "All numbers", .table = table_of(500, 40)});
  page.sections.push_back(
      {.heading = "The scenario", .text = "x", .preformatted = std::string(9000, '#')});
  expect_pages(page, 4, 4);
  std::string all;
  for (const std::string& one : paper_pages(page)) all += one;
  EXPECT_NE(all.find("More pictures are in the report: picture "), std::string::npos);
  EXPECT_NE(all.find(" more rows and "), std::string::npos);
}

TEST(Paper, WrapsLinesAtTheMargin) {
  const std::string word(40, 'w');
  const Page page{.title = "t", .summary = word + " " + word + " " + word + "\n", .sections = {}};
  const std::string first = paper_pages(page).front();
  EXPECT_NE(first.find(">" + word + " " + word + "</text>"), std::string::npos);
  EXPECT_NE(first.find(">" + word + "</text>"), std::string::npos);
}

TEST(SvgDrawing, IsPlacedInAnother) {
  SvgDrawing outer(300, 200, "o", "");
  outer.place(drawing_of(100, 50), {20, 30}, 0.5);
  EXPECT_NE(outer.finished().find(
                "<g transform=\"translate(20.00 30.00) scale(0.5000)\">\n<rect class=\"frame\" "
                "x=\"0.00\" y=\"0.00\" width=\"100.00\" height=\"50.00\"/>\n</g>\n</svg>\n"),
            std::string::npos);
  EXPECT_EQ(size_of_drawing(drawing_of(100, 50)).x, 100);
  EXPECT_EQ(size_of_drawing(drawing_of(100, 50)).y, 50);
}

}  // namespace
}  // namespace sim
