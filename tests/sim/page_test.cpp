// Reports as pages: what stands in them, that texts stay texts, and their answer on top.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "occurrences.hpp"
#include "sim/page/link_part.hpp"
#include "sim/page/page.hpp"
#include "sim/page/picture_sections.hpp"
#include "sim/page/verdict.hpp"
#include "sim/report/report_table.hpp"

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
                    .verdict = hostile + "\n" + hostile,
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

TEST(Page, KeepsTextThatIsNoUtf8) {
  const std::string page =
      page_as_html({.title = "a",
                    .verdict = {},
                    .sections = {{.heading = "b", .picture = picture_of(chart_named("\xff"))}}});
  EXPECT_EQ(charts_of(page)[0]["x"]["label"], "\xef\xbf\xbd");
}

TEST(Page, OpensTablesThatAreShortOrTheAnswer) {
  const auto opens = [](std::size_t rows, bool is_answer) {
    const PageTable table{.head = {"a"}, .rows = {rows, {"b"}}, .is_answer = is_answer};
    const std::string page =
        page_as_html({.title = "t", .verdict = {}, .sections = {{.heading = "h", .table = table}}});
    return occurrences(page, "<details open>") == 1;
  };
  EXPECT_TRUE(opens(20, false));
  EXPECT_FALSE(opens(21, false));
  EXPECT_TRUE(opens(1000, true));
}

TEST(Page, HasEachLiveChartAsAStillPictureToo) {
  Chart chart = chart_named("Loss");
  chart.curves[0].points.push_back({2, 0, 0, 0.02, true});
  chart.curves[0].points.push_back({3, std::nan(""), std::nan(""), std::nan("")});
  const std::string page = page_as_html(
      {.title = "t",
       .verdict = {},
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
      {.title = "t", .verdict = {}, .sections = {{.heading = "one"}, {.heading = hostile}}});
  EXPECT_NE(html.find("<a href=\"#section-0\">one</a>\n<a href=\"#section-1\">&lt;/script&gt;"),
            std::string::npos);
  EXPECT_NE(html.find("<section id=\"section-0\">\n<h2>one</h2>"), std::string::npos);
}

TEST(Page, IsKnownByItsBeginning) {
  EXPECT_EQ(page_as_html({.title = "t", .verdict = {}, .sections = {}})
                .find("<!DOCTYPE html>\n<!-- by cosys-sim -->\n"),
            0U);
}

// ---- what reports say ----

PointResult point_of(double x, std::uint64_t frames, std::uint64_t lost) {
  PointResult point{.coordinates = {x}};
  point.operating.snr_db = 30 - x;
  point.tally.n_frames = frames;
  point.tally.n_frames_lost = point.tally.n_frames_unheard = lost;
  point.tally.n_frames_ok = frames - lost;
  point.tally.n_bits = 170 * frames;
  point.tally.sum_bits_squared = 170 * 170 * frames;
  return point;
}

ExperimentResult sweep_of(std::vector<PointResult> points) {
  ExperimentResult result;
  result.title = "Title";
  result.scenario_toml = "text";
  result.command = "command";
  Axis axis{"receiver.range_m", "m", "range", {}};
  for (const PointResult& point : points) axis.values.push_back(point.coordinates[0]);
  result.axes = {axis};
  result.points = std::move(points);
  return result;
}

TEST(Verdict, SaysHowFarTheLinkReachesAndWhatItIsLikeWhereLossBegins) {
  const std::string words = verdict_of(sweep_of({point_of(1, 1000, 0), point_of(2, 1000, 0),
                                                 point_of(3, 1000, 200), point_of(4, 1000, 1000)}),
                                       {});
  EXPECT_EQ(words.find("4000 frames were simulated at 4 points; 1200 of them were lost.\n"), 0U);
  EXPECT_NE(words.find("\nFrame loss crosses 1 % between receiver.range_m = 2 .. 3 m (no point "
                       "lies between).\n"),
            std::string::npos)
      << words;
  EXPECT_NE(
      words.find("\nAt receiver.range_m = 4 m, 100.0 [99.6, 100.0] % of frames are lost; noise is "
                 "26 dB below the signal behind the band-pass.\n"),
      std::string::npos)
      << words;
}

TEST(Verdict, OfNoLossNamesNone) {
  const std::string words = verdict_of(sweep_of({point_of(1, 1000, 0), point_of(2, 1000, 0)}), {});
  EXPECT_NE(words.find("2000 frames were simulated at 2 points; 0 of them were lost.\n"),
            std::string::npos);
  EXPECT_EQ(words.find("frames are lost;"), std::string::npos) << words;
}

TEST(Verdict, OfOnePointGivesTheLossItsInterval) {
  const std::string words = verdict_of(sweep_of({point_of(1, 48, 0)}), {});
  EXPECT_EQ(
      words.find("48 frames were simulated; 0 of them were lost: frame loss ratio < 7.4e-2.\n"), 0U)
      << words;
}

TEST(Verdict, SaysHowManyPointsHaveNoEstimate) {
  ExperimentResult result = sweep_of({point_of(1, 48, 20), point_of(2, 48, 4), point_of(3, 48, 1)});
  for (PointResult& point : result.points) {  // one of a few runs makes all of the estimate
    point.tally.weighted.n_groups = 6;
    point.tally.weighted.bit_errors = {1, 1, 1, 1};
  }
  const std::string words = verdict_of(result, {});
  EXPECT_NE(words.find("\n3 of 3 points have no estimate and are missing in the curves.\n"),
            std::string::npos)
      << words;
  EXPECT_EQ(verdict_of(sweep_of({point_of(1, 48, 20)}), {}).find("estimate"), std::string::npos);
}

TEST(Verdict, SaysOnWhichSideOfTheSignalNoiseIs) {
  ExperimentResult result = sweep_of({point_of(1, 1000, 1000)});
  result.points[0].operating.snr_db = -32;
  EXPECT_NE(verdict_of(result, {}).find("; noise is 32 dB above the signal "), std::string::npos);
}

/// Modules A, B and so on, each with the loss at 1, 2 and 3 m.
ExperimentResult modules_of(const std::vector<std::array<std::uint64_t, 3>>& losses) {
  ExperimentResult result = sweep_of({});
  Axis modules{"receiver.module", "", "", {}};
  for (std::size_t i = 0; i < losses.size(); ++i) {
    modules.values.push_back(static_cast<double>(i));
    modules.labels.emplace_back(1, static_cast<char>('A' + i));
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = static_cast<double>(k) + 1;
      result.points.push_back(point_of(x, 1000, losses[i][k]));
      result.points.back().coordinates = {static_cast<double>(i), x};
    }
  }
  result.axes[0].values = {1, 2, 3};
  result.axes.insert(result.axes.begin(), modules);
  return result;
}

constexpr std::array<std::uint64_t, 3> near{0, 1000, 1000}, far{0, 0, 1000}, dead{1000, 1000, 1000};

TEST(Verdict, SaysHowFarEachOfAFewLinksReaches) {
  const std::string words = verdict_of(modules_of({near, far, dead}), {});
  EXPECT_NE(words.find("\nFrame loss passes 1 % along receiver.range_m at: receiver.module = B: "
                       "between 2 and 3 m; receiver.module = A: between 1 and 2 m; "
                       "receiver.module = C: short of the sweep: more than 1 % lost in all of 1 .. "
                       "3 m.\nOne point is looked at closer: at receiver.module = "),
            std::string::npos)
      << words;
}

TEST(Verdict, NamesTheLinksThatComeFirst) {
  const std::string one = verdict_of(modules_of({near, far, near, near, dead}), {});
  EXPECT_NE(one.find("\nOf 5 links B comes first. How far each reaches is listed below.\nOne "
                     "point is looked at closer: at receiver.module = "),
            std::string::npos)
      << one;
  const std::string two = verdict_of(modules_of({far, far, near, near, near}), {});
  EXPECT_NE(two.find("\nOf 5 links A, B come first. "), std::string::npos) << two;
  const std::string all = verdict_of(modules_of({far, far, far, far, far}), {});
  EXPECT_NE(all.find("\n5 links. How far each reaches is listed below.\n"), std::string::npos)
      << all;
}

Omission omission(const std::string& without, std::uint64_t lost) {
  return {without, point_of(0, 100, lost).tally};
}

std::vector<std::string> limit_names(const Omissions& omissions) {
  std::vector<std::string> names;
  for (const Omission& o : limits_of(omissions)) names.push_back(o.without);
  return names;
}

TEST(Verdict, SaysHowMuchFartherTheLinkWouldGo) {
  const ExperimentResult result = sweep_of({point_of(1, 100, 0), point_of(2, 100, 90)});
  Omissions omissions{
      "", {omission("", 90), omission("noise", 89), omission("the lamp", 3), omission("gain", 5)}};
  omissions.along = result.axes[0];
  omissions.omissions[0].half = HalfLoss{HalfLoss::Kind::between, 1.83};
  omissions.omissions[1].half = HalfLoss{HalfLoss::Kind::between, 1.9};
  omissions.omissions[2].half = HalfLoss{HalfLoss::Kind::between, 2.913};
  omissions.omissions[3].half = HalfLoss{HalfLoss::Kind::not_yet, 64};
  EXPECT_EQ(limit_names(omissions), (std::vector<std::string>{"gain", "the lamp"}))
      << "what carries farthest comes first";
  EXPECT_NE(verdict_of(result, omissions)
                .find("of 100 frames sent again 90 are lost, 5 without gain, 3 without the lamp.\n"
                      "Half of the frames are lost at about receiver.range_m = 1.83 m as it is, "
                      "beyond 64 m without gain, 2.91 m without the lamp.\n"),
            std::string::npos)
      << verdict_of(result, omissions);
  omissions.omissions[2].half.reset();
  EXPECT_NE(verdict_of(result, omissions).find("= 1.83 m as it is, beyond 64 m without gain.\n"),
            std::string::npos)
      << verdict_of(result, omissions);
  const ReportPart part = link_part({"file", result, omissions});
  const auto section = std::ranges::find(part.sections, "What limits it", &PageSection::heading);
  ASSERT_NE(section, part.sections.end());
  EXPECT_EQ(section->table->head.size(), section->table->rows[2].size());
  EXPECT_EQ(section->table->rows[1].back(), "1.9");
  EXPECT_EQ(section->table->rows[2].back(), "-");
}

TEST(Verdict, NamesWhatTheLossIsClearlyLessWithout) {
  const ExperimentResult result = sweep_of({point_of(1, 100, 0), point_of(2, 100, 90)});
  const Omissions some{
      "", {omission("", 90), omission("noise", 85), omission("the lamp", 3), omission("gain", 60)}};
  EXPECT_EQ(limit_names(some), (std::vector<std::string>{"the lamp", "gain"}));
  EXPECT_NE(verdict_of(result, some)
                .find("\nWhat limits it there: of 100 frames sent again 90 are "
                      "lost, 3 without the lamp, 60 without gain.\n"),
            std::string::npos);
  const Omissions none{"", {omission("", 90), omission("noise", 85), omission("gain", 90)}};
  EXPECT_NE(
      verdict_of(result, none)
          .find("\nWhat limits it there: none of these alone. Leaving out noise, or gain does "
                "not clearly lower the loss: it is several together, or light too weak for what "
                "the receiver needs.\n"),
      std::string::npos);
}

TEST(Report, HasThePicturesAndTablesOfAResult) {
  const Page page =
      page_of({link_part({"file", sweep_of({point_of(1, 10, 0), point_of(2, 10, 10)}), {}})});
  EXPECT_EQ(page.title, "Title");
  std::vector<std::string> headings;
  for (const PageSection& section : page.sections) headings.push_back(section.heading);
  EXPECT_EQ(headings, (std::vector<std::string>{"The scenario", "Bit errors", "Frame loss",
                                                "What became of the frames", "All numbers"}));
  const PageTable& fates = *page.sections[3].table;
  EXPECT_EQ(fates.rows[0], (std::vector<std::string>{"1", "10", "0", "0", "0"}));
  EXPECT_EQ(fates.rows[1], (std::vector<std::string>{"2", "0", "0", "0", "10"}));
  EXPECT_EQ(page.sections[0].text, "To repeat it: command");
  EXPECT_EQ(page.sections[0].preformatted, "text");
}

TEST(Report, OfSeveralResultsSaysFirstWhichReachesFarther) {
  const ExperimentResult one = sweep_of({point_of(1, 1000, 0), point_of(2, 1000, 1000)});
  const ExperimentResult two = sweep_of({point_of(2, 1000, 0), point_of(3, 1000, 1000)});
  const Page page = page_of({link_part({"one", one, {}}), link_part({"two", two, {}})});
  EXPECT_EQ(page.verdict.find("Frame loss passes 1 % along receiver.range_m at: one: between 1 and "
                              "2 m; two: between 2 and 3 m.\none: "),
            0U)
      << page.verdict;
  EXPECT_EQ(page.sections[0].heading, "How far each reaches");
  EXPECT_EQ(page.sections[0].table->rows,
            (std::vector<std::vector<std::string>>{{"two", "between 2 and 3 m"},
                                                   {"one", "between 1 and 2 m"}}));
  ExperimentResult lamps = two;
  lamps.axes[0].key = "ambient.irradiance_w_per_m2";
  EXPECT_EQ(
      page_of({link_part({"one", one, {}}), link_part({"lamps", lamps, {}})}).sections[0].heading,
      "Differences")
      << "distances and lights are not compared";
}

TEST(Report, OfSeveralResultsHasAPlaceForAllOfThemOnItsAxes) {
  const Chart tens{.title = "Frame loss",
                   .description = "d",
                   .x = {.label = "x", .logarithmic = true},
                   .y = {.label = "y", .logarithmic = true},
                   .curves = {{"tens", {{1, 0.5, 0.5, 0.5}, {100, 0.5, 0.5, 0.5}}}}};
  Chart from_zero = tens;
  from_zero.x.logarithmic = false;
  from_zero.y.level = 0.01;
  from_zero.curves[0].points[0].x = 0;
  const auto page = [](const Chart& first, const Chart& second) {
    ReportPart one{"one", "", ""}, two{"two", "", ""};
    one.charts = {first};
    two.charts = {second};
    return page_of({one, two});
  };
  for (const Page& both : {page(tens, from_zero), page(from_zero, tens)}) {
    const Chart& chart = both.sections.back().picture->live.value();
    EXPECT_EQ(chart.curves.size(), 2U);
    EXPECT_FALSE(chart.x.logarithmic) << "0 has no place there";
    EXPECT_TRUE(chart.y.logarithmic);
    EXPECT_EQ(chart.y.level, 0.01) << "though one alone has it";
  }
}

TEST(Report, MarksPointsAsRunDoesAndSaysHowManyOnTop) {
  ExperimentResult result =
      sweep_of({point_of(1, 10, 0), point_of(2, 10, 10), point_of(3, 10, 10)});
  result.points[0].outside = 1;
  result.points[0].operating.ber_theory = 0.25;
  result.points[1].alarms = result.points[2].alarms = 1;
  const ReportPart part = link_part({"file", result, {}});
  EXPECT_NE(part.verdict.find(
                "\nMarked in the table of all numbers: of 3 points 1 outside of what a model is "
                "valid for and 2 with an alarm.\n"),
            std::string::npos)
      << part.verdict;
  const PageSection& numbers = part.sections.back();
  EXPECT_EQ(numbers.heading, "All numbers");
  EXPECT_EQ(numbers.text, mark_notes(result));
  EXPECT_EQ(numbers.table->head[8], "BER in theory");
  EXPECT_EQ(numbers.table->rows[0][8], "0.2500");
  EXPECT_EQ(numbers.table->rows[0].back(), closing_text(result.points[0]));
  EXPECT_NE(numbers.table->rows[0].back().find(" ! "), std::string::npos);
  EXPECT_NE(numbers.table->rows[1].back().find(" !! "), std::string::npos);
}

TEST(Report, OfALinkWithoutNoiseHasADashForItsRatio) {
  ExperimentResult result = sweep_of({point_of(1, 10, 0)});
  result.points[0].operating.snr_db = std::numeric_limits<double>::infinity();
  const ReportPart part = link_part({"file", result, {}});
  EXPECT_EQ(part.sections.back().table->rows[0][2], "-");
}

TEST(Report, OfPointsWithoutMarksAndTheorySaysNothingOfThem) {
  const ReportPart part = link_part({"file", sweep_of({point_of(1, 10, 0)}), {}});
  EXPECT_EQ(part.verdict.find("Marked"), std::string::npos) << part.verdict;
  const PageSection& numbers = part.sections.back();
  EXPECT_EQ(std::ranges::count(numbers.table->head, "BER in theory"), 0);
}

TEST(Report, SumsFatesAlongTheLongestAxisWhereThereAreManyPoints) {
  ExperimentResult result = sweep_of({});
  result.axes = {{"receiver.module", "", "", {0, 1}, {"A", "B"}},
                 {"receiver.range_m", "m", "", {}}};
  for (int x = 0; x < 40; ++x) result.axes[1].values.push_back(x);
  for (const double module : {0, 1})
    for (int x = 0; x < 40; ++x) {
      const bool fails = module == 1 && x == 39;  // and has more frames
      result.points.push_back(point_of(x, fails ? 20 : 10, fails ? 8 : 0));
      result.points.back().coordinates = {module, static_cast<double>(x)};
    }
  const Page page = page_of({link_part({"file", result, {}})});
  const auto section =
      std::ranges::find(page.sections, "What became of the frames", &PageSection::heading);
  ASSERT_NE(section, page.sections.end());
  ASSERT_EQ(section->table->rows.size(), 40U);
  EXPECT_EQ(section->table->head[1], "delivered [%]");
  EXPECT_EQ(section->table->rows[39],
            (std::vector<std::string>{"39", "80.0", "0.0", "0.0", "20.0"}))
      << "both points weigh the same";
}

TEST(ChartSection, HasCountsAsTheyAreInItsTable) {
  Chart chart = chart_named("edges");
  chart.curves[0].points = {{1, 1561, 1561, 1561}, {2, 0.12345, 0.12345, 0.12345}};
  const PageSection section = chart_section(chart);
  EXPECT_EQ(section.table->rows[0][2], "1561");
  EXPECT_EQ(section.table->rows[1][2], "0.123");
}

}  // namespace
}  // namespace sim
