// Where the frame loss passes 1 %, row by row, and which row is best.
#include "sim/result/ranking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "sim/scenario/sweep.hpp"

namespace {

using Kind = sim::Crossing::Kind;
using Losses = std::vector<std::vector<std::uint64_t>>;  // of 1000 frames: one list a row

const sim::Axis range{"receiver.range_m", "m", "distance", {1, 2, 3, 4}};
const sim::Axis height{"receiver.height_mm", "mm", "height", {10, 50}};

sim::Axis modules(std::vector<std::string> labels) {
  sim::Axis axis{"receiver.module", "", "receiver module", {}, std::move(labels)};
  for (std::size_t i = 0; i < axis.labels.size(); ++i)
    axis.values.push_back(static_cast<double>(i));
  return axis;
}

sim::LinkPoint ranked_point(std::vector<double> coordinates, std::uint64_t lost) {
  sim::LinkPoint p;
  p.coordinates = std::move(coordinates);
  p.tally.n_frames = 1000;
  p.tally.n_frames_lost = lost;
  return p;
}

/// Rows by columns; the columns are the abscissa.
sim::LinkResult grid(const sim::Axis& rows, const sim::Axis& columns, const Losses& lost) {
  sim::LinkResult result;
  result.axes = {rows, columns};
  for (std::size_t i = 0; i < lost.size(); ++i)
    for (std::size_t j = 0; j < lost[i].size(); ++j)
      result.points.push_back(ranked_point({rows.values[i], columns.values[j]}, lost[i][j]));
  return result;
}

/// The same with its axes exchanged; points need no order here.
sim::LinkResult turned(const sim::LinkResult& result) {
  sim::LinkResult other = result;
  std::swap(other.axes[0], other.axes[1]);
  for (sim::LinkPoint& p : other.points) std::swap(p.coordinates[0], p.coordinates[1]);
  return other;
}

std::string lines(const sim::LinkResult& result) {
  return sim::ranking_lines(result, sim::rank(result));
}

const Losses losses{{0, 0, 1000, 1000},        // between 2 and 3 m
                    {1000, 1000, 1000, 1000},  // nowhere
                    {0, 0, 0, 0},              // beyond
                    {0, 900, 0, 900},          // up and down
                    {0, 1000, 1000, 1000},     // between 1 and 2 m
                    {0, 10, 150, 700}};        // fitted
const std::vector<std::string> part_names{"jump", "dead", "far", "odd", "short", "fitted-part"};

std::size_t index_of(const sim::RowCrossing& row) {
  return static_cast<std::size_t>(row.others.at(0));
}

const std::string& name_of(const sim::RowCrossing& row) { return part_names[index_of(row)]; }

TEST(Ranking, SortsTextsBestFirst) {
  const auto result = grid(modules(part_names), range, losses);
  std::vector<std::string> order;
  for (const auto& row : sim::rank(result).rows) order.push_back(name_of(row));
  EXPECT_EQ(order,
            (std::vector<std::string>{"far", "jump", "fitted-part", "short", "odd", "dead"}));
}

TEST(Ranking, EachRowIsTheCrossingOfItsOwnSweep) {
  const auto result = grid(modules(part_names), range, losses);
  for (const auto& row : sim::rank(result).rows) {
    sim::LinkResult alone;
    alone.axes = {range};
    for (std::size_t j = 0; j < 4; ++j)
      alone.points.push_back(ranked_point({range.values[j]}, losses[index_of(row)][j]));
    const sim::Crossing expected = sim::frame_loss_crossing(alone);
    EXPECT_EQ(row.crossing.kind, expected.kind) << name_of(row);
    EXPECT_EQ(row.crossing.at, expected.at) << name_of(row);
    EXPECT_EQ(row.crossing.high, expected.high) << name_of(row);
  }
}

// Wherever the axis of texts stands, and with numbers that fall.
TEST(BestFirst, OrdersTheTextsAndTheirPoints) {
  const sim::Axis falling{"receiver.range_m", "m", "distance", {4, 3, 2, 1}};
  Losses reversed = losses;
  for (auto& row : reversed) std::ranges::reverse(row);
  const auto check = [](const sim::LinkResult& result, std::size_t text, std::size_t number) {
    const sim::LinkResult sorted = sim::best_first(result, sim::rank(result));
    EXPECT_EQ(sorted.axes[text].labels,
              (std::vector<std::string>{"far", "jump", "fitted-part", "short", "odd", "dead"}));
    ASSERT_EQ(sorted.points.size(), result.points.size());
    for (std::size_t i = 0; i < sorted.points.size(); ++i) {
      const sim::LinkPoint& p = sorted.points[i];
      EXPECT_EQ(p.coordinates, sim::point_coordinates(sorted.axes, i));
      const std::string& name =
          sorted.axes[text].labels[static_cast<std::size_t>(p.coordinates[text])];
      const auto row = std::ranges::find(part_names, name) - part_names.begin();
      const auto column = static_cast<std::size_t>(p.coordinates[number]) - 1;
      EXPECT_EQ(p.tally.n_frames_lost, losses[static_cast<std::size_t>(row)][column]) << name;
    }
  };
  check(grid(modules(part_names), falling, reversed), 0, 1);
  sim::LinkResult last = turned(grid(modules(part_names), range, losses));
  std::ranges::sort(last.points, {}, &sim::LinkPoint::coordinates);
  check(last, 1, 0);
}

TEST(BestFirst, LeavesOthersAsTheyAre) {
  auto weighted = grid(modules(part_names), range, losses);
  for (sim::LinkPoint& p : weighted.points) p.tally.weighted.n_groups = 1;
  EXPECT_EQ(sim::best_first(weighted, sim::rank(weighted)).axes[0].labels, part_names);
  const sim::Axis current{"led.current_ma", "mA", "current", {10, 20, 50, 100, 200, 300}};
  const auto numbers = grid(current, range, losses);
  EXPECT_EQ(sim::best_first(numbers, sim::rank(numbers)).axes[0].values, numbers.axes[0].values);
}

TEST(Ranking, TextsMayBeTheLastAxis) {
  const auto result = grid(modules(part_names), range, losses);
  EXPECT_EQ(lines(turned(result)), lines(result));
}

TEST(Ranking, LeastIsBestWhereMoreHelps) {
  const sim::Axis current{"led.current_ma", "mA", "current", {10, 20, 50, 100}};
  const auto result =
      grid(modules({"thirsty", "frugal", "never", "always"}), current,
           {{1000, 1000, 1000, 0}, {1000, 0, 0, 0}, {900, 900, 900, 900}, {0, 0, 0, 0}});
  std::vector<std::size_t> order;
  for (const auto& row : sim::rank(result).rows) order.push_back(index_of(row));
  EXPECT_EQ(order, (std::vector<std::size_t>{3, 1, 0, 2}));
}

TEST(Ranking, SaysWhatToBuy) {
  auto result = grid(modules({"TSOP4856", "GP1", "TSSP4056"}), range,
                     {{0, 0, 1000, 1000}, {1000, 1000, 1000, 1000}, {0, 0, 0, 0}});
  result.points[11].validity_flags = 1;
  const std::string text = lines(result);
  const std::string head =
      "receiver.range_m at which frame loss passes 1 %, best first:\n"
      "      module    passes at\n"
      "   1  TSSP4056  more than 4 m  ! ";
  EXPECT_TRUE(text.starts_with(head)) << text;
  EXPECT_TRUE(
      text.ends_with("   2  TSOP4856  2 to 3 m\n"
                     "   3  GP1       less than 1 m\n"))
      << text;
}

TEST(Ranking, EqualsShareTheirPlace) {
  const auto result =
      grid(modules({"a", "b", "c", "d"}), range,
           {{0, 0, 1000, 1000}, {0, 1000, 1000, 1000}, {0, 0, 1000, 1000}, {0, 0, 0, 0}});
  std::vector<std::size_t> places;
  for (const auto& row : sim::rank(result).rows) places.push_back(row.place);
  EXPECT_EQ(places, (std::vector<std::size_t>{1, 2, 2, 4}));
}

TEST(Ranking, OfEqualsTheOneThatNothingFlagsComesFirst) {
  auto result = grid(modules({"odd", "sound"}), range, {{0, 0, 1000, 1000}, {0, 0, 1000, 1000}});
  result.points[2].validity_flags = 1;
  EXPECT_EQ(sim::rank(result).rows[0].others, std::vector<double>{1});
  EXPECT_EQ(sim::rank(result).rows[1].place, 1U);
}

// Whatever is swept beside it, by --set too.
TEST(Ranking, DistanceIsTheAbscissaWhereItIsSwept) {
  const auto result = turned(grid(height, range, {{0, 1000, 1000, 1000}, {0, 0, 0, 1000}}));
  ASSERT_EQ(result.axes[0].key, "receiver.range_m");
  const auto ranking = sim::rank(result);
  EXPECT_EQ(ranking.abscissa, 0U);
  EXPECT_EQ(ranking.others, std::vector<std::size_t>{1});
}

TEST(Ranking, OfTwoAxesOfNumbersTheLastIsTheAbscissa) {
  const auto result = grid(height, range, {{0, 1000, 1000, 1000}, {0, 0, 0, 1000}});
  EXPECT_EQ(lines(result),
            "receiver.range_m at which frame loss passes 1 %:\n"
            "  height_mm [mm]  passes at\n"
            "              10  1 to 2 m\n"
            "              50  3 to 4 m\n");
}

TEST(Ranking, EachCombinationOfTheOtherAxesIsARow) {
  const sim::Axis baud{"device.baud", "Bd", "line rate", {300, 1200}};
  sim::LinkResult result;
  result.axes = {baud, range, modules({"near", "far"})};
  for (const double b : baud.values)
    for (const double metres : range.values)
      for (const double module : {0.0, 1.0})
        result.points.push_back(
            ranked_point({b, metres, module}, metres > 1 + module + (b < 500 ? 1 : 0) ? 1000 : 0));
  EXPECT_EQ(lines(result),
            "receiver.range_m at which frame loss passes 1 %, best first:\n"
            "      baud [Bd]  module  passes at\n"
            "   1        300  far     3 to 4 m\n"
            "   2        300  near    2 to 3 m\n"
            "   1       1200  far     2 to 3 m\n"
            "   2       1200  near    1 to 2 m\n");
}

// An interrupted run counts the near points of all, or of some, alone.
TEST(Ranking, GivesWhatIsNotCountedFarEnoughNoPlace) {
  sim::LinkResult result =
      grid(modules({"begun", "never", "dead", "done"}), range,
           {{0, 0, 0, 0}, {0, 0, 0, 0}, {1000, 1000, 1000, 1000}, {0, 1000, 1000, 1000}});
  for (std::size_t untouched = 2; untouched < 8; ++untouched)
    result.points[untouched].tally = sim::Tally{};
  EXPECT_EQ(lines(result),
            "receiver.range_m at which frame loss passes 1 %, best first:\n"
            "      module  passes at\n"
            "   1  done    1 to 2 m\n"
            "   2  dead    less than 1 m\n"
            "   -  begun   not told yet: counted at 1 .. 2 m alone\n"
            "   -  never   not counted yet\n");
}

TEST(Ranking, OfOneAxisIsOneSentence) {
  sim::LinkResult result;
  result.axes = {range};
  for (const double x : range.values) result.points.push_back(ranked_point({x}, x < 3 ? 0 : 1000));
  EXPECT_EQ(lines(result),
            "the link reaches 2 to 3 m at 1 % frame loss, two neighbours in the sweep\n");
}

const double infinity = std::numeric_limits<double>::infinity();
const sim::RangeDoubt doubt{"A", 16, {{{1, 2}, {2, 3}, {4, infinity}}}};

TEST(Ranking, SaysTheDoubtOfItsOnlyRow) {
  sim::LinkResult result;
  result.axes = {range};
  for (const double x : range.values) result.points.push_back(ranked_point({x}, 0));
  sim::Ranking ranking = sim::rank(result);
  ranking.rows[0].doubt = doubt;
  EXPECT_EQ(sim::ranking_lines(result, ranking),
            lines(result) +
                "as assumed; 1 m to beyond 4 m for 8 of 10 units, as not all of A is known "
                "(--doubt says more; measure yours: cosys-sim fit)\n");
  ranking.rows[0].doubt->is_measured = true;
  EXPECT_EQ(sim::ranking_lines(result, ranking),
            lines(result) +
                "as measured; 1 m to beyond 4 m in 8 of 10 cases, as not all of A is told "
                "(--doubt says more)\n");
  ranking.rows[0].doubt->breaks_rule = true;
  EXPECT_EQ(sim::ranking_lines(result, ranking),
            lines(result) +
                "do not rely on it: A was measured, and does not follow the rule of the model "
                "(cosys-sim fit)\n");
}

TEST(Ranking, SaysTheDoubtsOfSeveralRowsInFewWords) {
  const sim::LinkResult result =
      grid(modules({"A", "B"}), range, {{0, 1000, 1000, 1000}, {0, 0, 0, 0}});
  sim::Ranking ranking = sim::rank(result);
  ranking.rows[1].doubt = doubt;
  EXPECT_EQ(sim::ranking_lines(result, ranking),
            "receiver.range_m at which frame loss passes 1 %, best first:\n"
            "      module  passes at      8 of 10 units\n"
            "   1  B       more than 4 m\n"
            "   2  A       1 to 2 m       1 m to beyond 4 m\n"
            "as assumed; 8 of 10 units: of 16 drawn within what is not known of a part (--doubt "
            "says more; measure yours: cosys-sim fit)\n");
  const std::string sound = sim::ranking_lines(result, ranking);
  ranking.rows[1].doubt->is_measured = true;
  EXPECT_TRUE(sim::ranking_lines(result, ranking)
                  .ends_with("as measured; 8 of 10 units: of 16 drawn within what is not told of a "
                             "part (--doubt says more)\n"));
  ranking.rows[1].doubt->is_measured = false;
  ranking.rows[0].doubt = ranking.rows[1].doubt;
  for (sim::RowCrossing& row : ranking.rows) row.doubt->breaks_rule = true;
  const std::string broken = sim::ranking_lines(result, ranking);
  EXPECT_NE(broken, sound);
  EXPECT_TRUE(
      broken.ends_with("fit)\ndo not rely on it: A was measured, and does not follow the "
                       "rule of the model (cosys-sim fit)\n"))
      << broken;
  EXPECT_EQ(broken.find("do not rely"), broken.rfind("do not rely")) << "once a part";
}

TEST(Ranking, IsEmptyForOtherSweeps) {
  sim::LinkResult result;
  result.points = {ranked_point({}, 0)};
  EXPECT_EQ(lines(result), "");
  result.axes = {modules({"a"})};
  result.points = {ranked_point({0}, 0)};
  EXPECT_EQ(lines(result), "");
  EXPECT_EQ(lines(grid(modules({"a", "b"}), modules({"c"}), {{0}, {0}})), "");
}

}  // namespace
