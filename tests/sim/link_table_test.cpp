#include "sim/link_experiment/link_notes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "link_table.hpp"
#include "measured_point.hpp"
#include "text_lines.hpp"

namespace {

using sim::lines_of;
using sim::measured_point;
using sim::text_axes;

const std::vector<sim::Axis> one_axis{{"receiver.range_m", "m", "distance", {7.5}}};
const std::vector<sim::Axis> range_and_ambient{
    {"receiver.range_m", "m", "distance", {7.5}},
    {"ambient.irradiance_w_per_m2", "W/m2", "ambient irradiance", {0.6}}};

std::string row(const sim::LinkPoint& p) { return sim::link_row(p, one_axis); }

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(TableRow, ShowsTheWholePoint) {
  EXPECT_EQ(row(measured_point()),
            "       7.5       0.312    14.2        1000         340  2.0e-3 [1.6e-3, 2.5e-3]     "
            "0.10 [0.08, 0.13]              310x  max_frame_errors\n");
}

TEST(TableRow, ShowsNoErrorsAsAnUpperLimit) {
  sim::LinkPoint p = measured_point();
  p.tally.n_frames_lost = 0;
  EXPECT_TRUE(has(row(p), "  < 3.7e-3  ")) << row(p);  // 1 - 0.025^(1/1000)
  EXPECT_FALSE(has(row(p), "[0")) << row(p);
}

TEST(TableRow, ShowsWhatIsNotKnownAsADash) {
  sim::LinkPoint p;
  p.coordinates = {7.5};
  std::istringstream cells(row(p));
  std::vector<std::string> words;
  for (std::string word; cells >> word;) words.push_back(word);
  EXPECT_EQ(words, (std::vector<std::string>{"7.5", "-", "-", "0", "0", "-", "-", "-", "-"}));
}

TEST(TableRow, GivesMoreDigitsToMoreCounts) {
  sim::LinkPoint p = measured_point();
  p.tally.n_frames = 100;
  p.tally.n_frames_lost = 10;
  EXPECT_TRUE(has(row(p), "  0.10 [0.04, 0.18]  ")) << row(p);
  p.tally.n_frames = 1'000'000;
  p.tally.n_frames_lost = 100'000;
  EXPECT_TRUE(has(row(p), "  0.100 [0.099, 0.101]  ")) << row(p);
}

TEST(TableRow, KeepsItsColumnsFromNanosToMegas) {
  const auto header = lines_of(sim::link_table(one_axis).head());
  for (const double size : {1e-9, 1.2345e-4, 0.3, 1.0, 1e3, 1e6}) {
    sim::LinkPoint p = measured_point();
    p.coordinates = {size};
    p.operating.irradiance_mw_per_m2 = size;
    p.operating.snr_db = std::log10(size) * 10;
    p.tally.n_frames = 1'000'000'000;
    p.tally.n_frames_lost = static_cast<std::uint64_t>(std::min(size, 1.0) * 1e9);
    const std::string line = row(p);
    EXPECT_EQ(line.find("max_frame_errors"), header[2].find("stopped by")) << line;
    EXPECT_LE(line.size(), 150U);
  }
}

TEST(TableRow, FitsAScreenWithTwoAxes) {
  sim::LinkPoint p = measured_point();
  p.coordinates = {7.5, 0.6};
  EXPECT_LE(sim::link_row(p, range_and_ambient).size(), 160U);
  for (const auto& line : lines_of(sim::link_table(range_and_ambient).head()))
    EXPECT_LE(line.size(), 152U);
}

TEST(TableRow, ShowsTextsToTheLeftInAColumnAsWideAsTheLongest) {
  sim::LinkPoint p = measured_point();
  p.coordinates = {0, 3};
  EXPECT_TRUE(sim::link_row(p, text_axes).starts_with("TSOP4856                3  "));
  p.coordinates = {1, 3};
  EXPECT_TRUE(sim::link_row(p, text_axes).starts_with("a-longer-name           3  "));
  const auto lines = lines_of(sim::link_table(text_axes).head());
  EXPECT_TRUE(lines[1].starts_with("module            range_m  ")) << lines[1];
}

TEST(TableHeader, NamesTheAxesAndUnits) {
  const auto lines = lines_of(sim::link_table(one_axis).head());
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_TRUE(has(lines[0], "receiver"));
  EXPECT_TRUE(has(lines[1], "range_m"));
  EXPECT_TRUE(has(lines[2], "[m]") && has(lines[2], "[mW/m2]") && has(lines[2], "[dB]"));
  EXPECT_EQ(lines_of(sim::link_table({}).head()).size(), 2U);
}

TEST(LossReasons, AreThoseOfAllPointsTogether) {
  sim::LinkResult result;
  result.points = {measured_point(), measured_point()};
  for (sim::LinkPoint& p : result.points) p.tally.n_frames_lost = 0;
  EXPECT_EQ(sim::loss_reasons(result), "");
  result.points[0].tally.n_frames_lost = 30;
  result.points[0].tally.n_frames_unheard = 10;
  result.points[1].tally.n_frames_lost = 5;
  result.points[1].tally.n_rejected_unprintable = 25;
  EXPECT_EQ(sim::loss_reasons(result),
            "35 frames lost: nothing heard 10, unprintable characters 25 (a frame may have several "
            "reasons)\n");
}

TEST(MissingLines, CountsWhatAStopLeft) {
  sim::LinkResult result;
  result.points = {measured_point(), measured_point(), {}};
  result.points[1].stop = sim::StopReason::interrupted;
  EXPECT_EQ(
      sim::missing_lines(result),
      "unfinished: 2 of 3 points, 1 of them not begun; what follows is of what was counted\n");
  result.points.pop_back();
  EXPECT_EQ(sim::missing_lines(result),
            "unfinished: 1 of 2 points; what follows is of what was counted\n");
  result.points = {measured_point()};
  EXPECT_EQ(sim::missing_lines(result), "");
}

}  // namespace
