// Pages: what stands in them, and that texts stay texts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "occurrences.hpp"
#include "sim/page/embedded.hpp"
#include "sim/page/page.hpp"
#include "sim/section/picture_sections.hpp"

namespace sim {
namespace {

const std::string hostile = "</script><script>alert(\"1\")</script>&<!--";

Chart chart_named(const std::string& name) {
  return {.title = name,
          .description = name,
          .x = {name, false},
          .y = {name, true},
          .curves = {{name, {{1, 0.1, 0.05, 0.2}}}}};
}

/// What the script of a page is given.
nlohmann::json charts_of(const std::string& page) {
  const std::string begin = "id=\"charts\">";
  const std::size_t at = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(at, page.find("</script>", at) - at));
}

TEST(Page, ShowsTextsAsTexts) {
  const std::string page =
      page_as_html({.title = hostile,
                    .summary = hostile + "\n" + hostile,
                    .sections = {{.heading = hostile,
                                  .text = hostile,
                                  .preformatted = hostile,
                                  .picture = picture_of(chart_named(hostile)),
                                  .table = PageTable{{hostile}, {{hostile}}}}}});
  EXPECT_EQ(occurrences(page, "<script>alert"), 0U);
  EXPECT_EQ(occurrences(page, "<!--"), 2U) << "its own mark, and the drawing's";
  EXPECT_GE(occurrences(page, "&lt;/script&gt;&lt;script&gt;alert(&quot;1&quot;)"), 8U);
  EXPECT_EQ(charts_of(page)[0]["x"]["label"], hostile);
}

TEST(Page, HasTheLicenceOfWhatItEmbeds) {
  if (uplot_script.empty()) GTEST_SKIP() << "built without uPlot, which npm fetches (Debian: npm)";
  const std::string page = page_as_html({.title = "a", .summary = {}, .sections = {}});
  EXPECT_EQ(occurrences(page, "Leon Sorokin"), 1U);
  EXPECT_EQ(occurrences(page, "Permission is hereby granted"), 1U);
}

TEST(Page, KeepsTextThatIsNoUtf8) {
  const std::string page =
      page_as_html({.title = "a",
                    .summary = {},
                    .sections = {{.heading = "b", .picture = picture_of(chart_named("\xff"))}}});
  EXPECT_EQ(charts_of(page)[0]["x"]["label"], "\xef\xbf\xbd");
}

TEST(Page, OpensTablesThatAreShortOrTheAnswer) {
  const auto opens = [](std::size_t rows, bool is_answer) {
    const PageTable table{.head = {"a"}, .rows = {rows, {"b"}}, .is_answer = is_answer};
    const std::string page =
        page_as_html({.title = "t", .summary = {}, .sections = {{.heading = "h", .table = table}}});
    return occurrences(page, "<details open>") == 1;
  };
  EXPECT_TRUE(opens(20, false));
  EXPECT_FALSE(opens(21, false));
  EXPECT_TRUE(opens(1000, true));
}

TEST(Page, BeginsWithASentenceAndThePictureOfTheAnswer) {
  PageSection ranges{.heading = "Ranges", .picture = picture_of(chart_named("Reach"))};
  const auto places = [&] {
    const std::string page = page_as_html(
        {.title = "t", .summary = "First.\nSecond.\n", .sections = {ranges, {.heading = "Last"}}});
    EXPECT_EQ(occurrences(page, "<h2>Ranges</h2>"), 1U);
    EXPECT_EQ(occurrences(page, "<details open"), 0U) << "what else is said follows the picture";
    return std::vector{page.find("First."), page.find("<h2>Ranges</h2>"), page.find("Second."),
                       page.find("<nav"), page.find("<h2>Last</h2>")};
  };
  const auto no_answer = places();
  EXPECT_LT(no_answer[2], no_answer[3]);
  EXPECT_LT(no_answer[3], no_answer[1]);
  ranges.table = PageTable{.head = {"a"}, .rows = {{"b"}}, .is_answer = true};
  const auto answer = places();
  EXPECT_TRUE(std::ranges::is_sorted(answer)) << "sentence, picture, more words, contents, others";
}

TEST(Page, HasEachLiveChartAsAStillPictureToo) {
  Chart chart = chart_named("Loss");
  chart.curves[0].points.push_back({2, 0, 0, 0.02, true});
  chart.curves[0].points.push_back({3, std::nan(""), std::nan(""), std::nan("")});
  const std::string page = page_as_html(
      {.title = "t",
       .summary = {},
       .sections = {{.heading = "one", .picture = picture_of(chart)},
                    {.heading = "two", .picture = PagePicture{"still", "words", "<svg></svg>"}},
                    {.heading = "three", .picture = picture_of(chart_named("BER"))}}});
  EXPECT_EQ(occurrences(page, "<div class=\"chart\""), 2U);
  EXPECT_EQ(occurrences(page, "<div class=\"still\">"), 3U);
  const auto charts = charts_of(page);
  ASSERT_EQ(charts.size(), 2U);
  EXPECT_EQ(charts[1]["y"]["label"], "BER");
  EXPECT_EQ(charts[0]["curves"][0]["points"][0],
            nlohmann::json::parse(R"({"x":1.0,"y":0.1,"low":0.05,"high":0.2,"is_limit":false})"));
  EXPECT_EQ(charts[0]["curves"][0]["points"][1]["is_limit"], true);
  EXPECT_EQ(charts[0]["curves"][0]["colour"], 0);
  EXPECT_TRUE(charts[0]["curves"][0]["points"][2]["y"].is_null());
}

TEST(Page, LeadsToItsSections) {
  const std::string html = page_as_html(
      {.title = "t", .summary = {}, .sections = {{.heading = "one"}, {.heading = hostile}}});
  EXPECT_NE(html.find("<a href=\"#section-0\">one</a>\n<a href=\"#section-1\">&lt;/script&gt;"),
            std::string::npos);
  EXPECT_NE(html.find("<section id=\"section-0\">\n<h2>one</h2>"), std::string::npos);
}

TEST(Page, IsKnownByItsBeginning) {
  EXPECT_EQ(page_as_html({.title = "t", .summary = {}, .sections = {}})
                .find("<!DOCTYPE html>\n<!-- by cosys-sim -->\n"),
            0U);
}

TEST(ChartSection, HasCountsAsTheyAreInItsTable) {
  Chart chart = chart_named("edges");
  chart.curves[0].points = {{1, 1561, 1561, 1561}, {2, 0.12345, 0.12345, 0.12345}};
  const PageSection section = chart_section(chart);
  EXPECT_EQ(section.table->rows[0][1], "1561");
  EXPECT_EQ(section.table->rows[1][1], "0.123");
}

}  // namespace
}  // namespace sim
