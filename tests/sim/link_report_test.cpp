// The page of a link's results: its sections, and several results side by side.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "lossy_sweep.hpp"
#include "sim/link_experiment/link_notes.hpp"
#include "sim/page/link_section.hpp"
#include "sim/page/page.hpp"

namespace sim {
namespace {

/// Of the first row.
std::string cell_under(const PageTable& table, const std::string& heading) {
  const auto column = std::ranges::find(table.head, heading) - table.head.begin();
  return table.rows.at(0).at(static_cast<std::size_t>(column));
}

TEST(Report, HasThePicturesAndTablesOfAResult) {
  const Page page = page_of(
      {link_section(link_report_of("file", sweep_of({point_of(1, 10, 0), point_of(2, 10, 10)})))});
  EXPECT_EQ(page.title, "Title");
  std::vector<std::string> headings;
  for (const PageSection& section : page.sections) headings.push_back(section.heading);
  EXPECT_EQ(headings,
            (std::vector<std::string>{"Frame loss", "Bit errors", "What became of the frames",
                                      "All numbers", "The scenario"}));
  const PageTable& fates = *page.sections[2].table;
  EXPECT_EQ(fates.rows[0], (std::vector<std::string>{"1", "10", "0", "0", "0"}));
  EXPECT_EQ(fates.rows[1], (std::vector<std::string>{"2", "0", "0", "0", "10"}));
  EXPECT_EQ(page.sections[4].text.find("To repeat it: command\nHere is all that ran"), 0U);
  EXPECT_EQ(page.sections[4].preformatted, "text");
}

TEST(Report, NamesCurvesInTablesWhereThereAreSeveral) {
  const LinkReport link =
      link_report_of("file", sweep_of({point_of(1, 10, 0), point_of(2, 10, 10)}));
  const PageTable alone = *page_of({link_section(link)}).sections[0].table;
  EXPECT_EQ(alone.head,
            (std::vector<std::string>{"receiver.range_m [m]", "frame loss ratio (FLR)"}));
  EXPECT_EQ(alone.rows[1][0], "2");
  LinkReport other = link;
  other.name = "other";
  const Page both = page_of({link_section(link), link_section(other)});
  const auto loss = std::ranges::find(both.sections, "Frame loss", &PageSection::heading);
  EXPECT_EQ(loss->table->head[0], "curve");
  EXPECT_EQ(loss->table->rows[1][0], "file, simulated");
}

TEST(Report, OfSeveralResultsSaysFirstWhichReachesFarther) {
  const LinkResult one = sweep_of({point_of(1, 1000, 0), point_of(2, 1000, 1000)});
  const LinkResult two = sweep_of({point_of(2, 1000, 0), point_of(3, 1000, 1000)});
  const Page page =
      page_of({link_section(link_report_of("one", one)), link_section(link_report_of("two", two))});
  EXPECT_EQ(
      page.summary.find("Frame loss passes 1 % along receiver.range_m at: one: 1 to 2 m; two: "
                        "2 to 3 m.\none: "),
      0U)
      << page.summary;
  EXPECT_EQ(page.sections[0].heading, "How far each reaches");
  EXPECT_EQ(page.sections[0].table->rows,
            (std::vector<std::vector<std::string>>{{"two", "2 to 3 m"}, {"one", "1 to 2 m"}}));
  LinkResult lamps = two;
  lamps.axes[0].key = "ambient.irradiance_w_per_m2";
  EXPECT_EQ(page_of({link_section(link_report_of("one", one)),
                     link_section(link_report_of("lamps", lamps))})
                .sections[0]
                .heading,
            "Differences")
      << "distances and lights are not compared";
}

TEST(Report, ComparesReachesOfSeveralResultsAlone) {
  ReportSection links{"links", "", ""}, arena{"arena", "", ""};
  links.link_ranges = {LinkRange{}, LinkRange{}};
  EXPECT_EQ(page_of({links, arena}).sections[0].heading, "Differences");
  EXPECT_NE(page_of({links, links}).sections[0].heading, "Differences");
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
  from_zero.y.from_zero = true;
  from_zero.curves[0].points[0].x = 0;
  const auto page = [](const Chart& first, const Chart& second) {
    ReportSection one{"one", "", ""}, two{"two", "", ""};
    one.charts = {first};
    two.charts = {second};
    return page_of({one, two});
  };
  for (const Page& both : {page(tens, from_zero), page(from_zero, tens)}) {
    const Chart& chart = both.sections[1].picture->live.value();
    EXPECT_EQ(chart.curves.size(), 2U);
    EXPECT_FALSE(chart.x.logarithmic) << "0 has no place there";
    EXPECT_TRUE(chart.y.logarithmic);
    EXPECT_EQ(chart.y.level, 0.01) << "though one alone has it";
    EXPECT_TRUE(chart.y.from_zero);
  }
}

TEST(Report, MarksPointsAsRunDoesAndSaysHowManyOnTop) {
  LinkResult result = sweep_of({point_of(1, 10, 0), point_of(2, 10, 10), point_of(3, 10, 10)});
  result.points[0].validity_flags = 1;
  result.points[0].operating.ber_theory = 0.25;
  result.points[1].alarms = result.points[2].alarms = 1;
  const ReportSection part = link_section(link_report_of("file", result));
  EXPECT_NE(part.summary.find(
                "\nMarked in the table of all numbers: of 3 points 1 outside of what a model is "
                "valid for and 2 with an alarm.\n"),
            std::string::npos)
      << part.summary;
  const PageSection& numbers = part.sections.back();
  EXPECT_EQ(numbers.heading, "All numbers");
  EXPECT_EQ(numbers.text, mark_notes(result));
  EXPECT_EQ(cell_under(*numbers.table, "BER in theory"), "0.2500");
  EXPECT_EQ(numbers.table->rows[0].back(), closing_text(result.points[0]));
  EXPECT_NE(numbers.table->rows[0].back().find(" ! "), std::string::npos);
  EXPECT_NE(numbers.table->rows[1].back().find(" !! "), std::string::npos);
}

TEST(Report, OfALinkWithoutNoiseHasADashForItsRatio) {
  LinkResult result = sweep_of({point_of(1, 10, 0)});
  result.points[0].operating.snr_db = std::numeric_limits<double>::infinity();
  const ReportSection part = link_section(link_report_of("file", result));
  EXPECT_EQ(cell_under(*part.sections.back().table, "SNR [dB]"), "-");
}

TEST(Report, OfPointsWithoutMarksAndTheorySaysNothingOfThem) {
  const ReportSection part = link_section(link_report_of("file", sweep_of({point_of(1, 10, 0)})));
  EXPECT_EQ(part.summary.find("Marked"), std::string::npos) << part.summary;
  const PageSection& numbers = part.sections.back();
  EXPECT_EQ(std::ranges::count(numbers.table->head, "BER in theory"), 0);
}

/// So many modules at 1 and 2 m, with theory.
std::vector<std::string> headings_of(std::size_t modules) {
  LinkResult result = sweep_of({});
  Axis names{"receiver.module", "", "", {}};
  for (std::size_t i = 0; i < modules; ++i) {
    names.values.push_back(static_cast<double>(i));
    names.labels.push_back(std::to_string(i));
    for (const double x : {1.0, 2.0}) {
      result.points.push_back(point_of(x, 10, 5));
      result.points.back().coordinates = {names.values.back(), x};
      result.points.back().operating.ber_theory = 0.1;
    }
  }
  result.axes[0].values = {1, 2};
  result.axes.insert(result.axes.begin(), names);
  std::vector<std::string> headings;
  for (const PageSection& section :
       page_of({link_section(link_report_of("file", result))}).sections)
    headings.push_back(section.heading);
  return headings;
}

TEST(Report, HasTheMapAboveMoreCurvesThanCanBeToldApart) {
  const auto map_comes_first = [](const std::vector<std::string>& headings) {
    return std::ranges::find(headings, "Map of frame loss") <
           std::ranges::find(headings, "Frame loss");
  };
  EXPECT_FALSE(map_comes_first(headings_of(6)));
  EXPECT_TRUE(map_comes_first(headings_of(7)));
}

TEST(Report, SumsFatesAlongTheLongestAxisWhereThereAreManyPoints) {
  LinkResult result = sweep_of({});
  result.axes = {{"receiver.module", "", "", {0, 1}, {"A", "B"}},
                 {"receiver.range_m", "m", "", {}}};
  for (int x = 0; x < 40; ++x) result.axes[1].values.push_back(x);
  for (const double module : {0, 1})
    for (int x = 0; x < 40; ++x) {
      const bool fails = module == 1 && x == 39;  // and has more frames
      result.points.push_back(point_of(x, fails ? 20 : 10, fails ? 8 : 0));
      result.points.back().coordinates = {module, static_cast<double>(x)};
    }
  const Page page = page_of({link_section(link_report_of("file", result))});
  const auto section =
      std::ranges::find(page.sections, "What became of the frames", &PageSection::heading);
  ASSERT_NE(section, page.sections.end());
  ASSERT_EQ(section->table->rows.size(), 40U);
  EXPECT_EQ(section->table->head[1], "delivered [%]");
  EXPECT_EQ(section->table->rows[39],
            (std::vector<std::string>{"39", "80.0", "0.0", "0.0", "20.0"}))
      << "both points weigh the same";
}

}  // namespace
}  // namespace sim
