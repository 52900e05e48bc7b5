// Datasets as curves, tables and words of a report.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/loading/load_scenario.hpp"
#include "sim/location/location_keys.hpp"  // the kinds that some scenarios are of
#include "sim/section/dataset_cells.hpp"
#include "sim/section/dataset_charts.hpp"
#include "sim/section/dataset_shares.hpp"
#include "sim/section/dataset_table.hpp"
#include "sim/section/dataset_words.hpp"
#include "sim/section/swept_maps.hpp"
#include "sim/section/swept_rows.hpp"

namespace sim {
namespace {

using Reals = std::vector<double>;
using Counts = std::vector<std::int64_t>;
const double nan = std::nan("");

/// Two detectors at three ranges, of which the last was never reached.
Dataset swept() {
  Dataset data;
  data.axes = {{"presence.detector", "", "detector", {0, 1}, {"goertzel", "dc"}},
               {"receiver.range_m", "m", "distance", {1, 3, 2}}};
  data.dimensions = {{{"sender", "", "node"}, std::vector<std::string>{"A", "B"}},
                     {{"false_alarm", "1", "as set"}, Reals{0.1, 0.001}}};
  data.variables = {
      {{"n_runs", "1", ""}, true, {}, Counts{4, 4, 4, 4, 4, 0}},
      {{"loss", "1", ""}, true, {}, Reals{0, 0.5, 0.25, 0.1, 0.9, nan}},
      {{"loss_ci_low", "1", ""}, true, {}, Reals{0, 0.4, 0.2, 0.05, 0.8, nan}},
      {{"loss_ci_high", "1", ""}, true, {}, Reals{0.01, 0.6, 0.3, 0.2, 0.95, nan}},
      {{"law", "1", ""}, true, {}, Reals{0.01, 0.4, 0.2, nan, nan, nan}},
      {{"age", "s", ""}, true, {"sender"}, Reals{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, nan, nan}},
      {{"n_sent", "1", ""}, true, {"sender"}, Counts{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 0, 0}}};
  return data;
}

const ChartCurve& curve(const Chart& chart, const std::string& name) {
  for (const ChartCurve& each : chart.curves)
    if (each.name == name) return each;
  throw std::runtime_error("no curve " + name);
}

TEST(DatasetCharts, DrawAVariableOverTheWidestAxis) {
  const auto chart = swept_chart(
      swept(), {"loss", {.title = "t", .label = "l", .logarithmic = true, .theory = "law"}});
  ASSERT_TRUE(chart);
  EXPECT_EQ(chart->x.label, "receiver.range_m [m]");
  EXPECT_EQ(chart->curves.size(), 3U) << "two measured, one of theory";
  const ChartCurve& goertzel = curve(*chart, "goertzel");
  ASSERT_EQ(goertzel.points.size(), 3U);
  EXPECT_EQ(goertzel.points[1].x, 2) << "from left to right";
  EXPECT_EQ(goertzel.points[1].y, 0.25);
  EXPECT_EQ(goertzel.points[1].low, 0.2);
  EXPECT_EQ(goertzel.points[1].high, 0.3);
  EXPECT_FALSE(goertzel.points[1].is_limit);
  EXPECT_TRUE(goertzel.points[0].is_limit) << "nothing found: a limit";
  EXPECT_EQ(curve(*chart, "dc").points.size(), 2U) << "what was never reached";
  const ChartCurve& theory = curve(*chart, "goertzel, theory");
  EXPECT_EQ(theory.kind, CurveKind::theory);
  EXPECT_EQ(theory.points.at(2).y, 0.4);
}

TEST(DatasetCharts, KeepATheoryBesideWhatItIsTheTheoryOf) {
  Dataset data = swept();
  data.variables[1].values = Reals{nan, nan, nan, 0, 0.9, nan};
  data.variables[4].values = Reals{0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  const DrawnVariable drawn{"loss", {.title = "t", .label = "l", .theory = "law"}};
  const Chart chart = swept_chart(data, drawn).value();
  ASSERT_EQ(chart.curves.size(), 4U) << "one of nothing, but its theory";
  EXPECT_EQ(chart.curves[1].name, "goertzel, theory");
  EXPECT_EQ(colour_of(chart, 1), 0U);
  EXPECT_EQ(colour_of(chart, 3), 1U);
  EXPECT_FALSE(curve(chart, "dc").points.at(0).is_limit) << "0 has a place on a linear axis";
  data.variables[4].values = Reals(6, nan);
  EXPECT_EQ(swept_chart(data, drawn).value().curves.size(), 1U);
}

TEST(DatasetCharts, ACurveForEachElementOfADimension) {
  const auto chart = swept_chart(swept(), {"age", {.title = "t", .label = "l"}});
  ASSERT_TRUE(chart);
  EXPECT_EQ(chart->curves.size(), 4U);
  const ChartCurve& b = curve(*chart, "dc, sender B");
  EXPECT_EQ(b.points.at(0).y, 8);
  EXPECT_EQ(b.points.at(1).y, 10);
  EXPECT_EQ(b.points.at(1).low, b.points.at(1).high) << "no interval";
}

TEST(DatasetCharts, OverADimensionOfNumbers) {
  Dataset data;
  data.dimensions = swept().dimensions;
  data.variables = {{{"p", "1", ""}, true, {"false_alarm"}, Reals{0.9, 0.5}},
                    {{"q", "1", ""}, true, {"sender"}, Reals{0.9, 0.5}}};
  const auto chart = dimension_chart(data, {"p", {.title = "ROC", .label = "l"}});
  ASSERT_TRUE(chart);
  EXPECT_EQ(chart->x.label, "as set");
  EXPECT_TRUE(chart->x.logarithmic) << "two decades";
  ASSERT_EQ(chart->curves.size(), 1U);
  EXPECT_EQ(chart->curves[0].name, "simulated");
  EXPECT_EQ(chart->curves[0].points.at(0).x, 0.001);
  EXPECT_EQ(chart->curves[0].points.at(0).y, 0.5);
  EXPECT_FALSE(dimension_chart(data, {"q", {.title = "", .label = ""}})) << "of texts";
  EXPECT_FALSE(dimension_chart(data, {"none", {.title = "", .label = ""}}));
}

TEST(DatasetCharts, NothingWhereNoNumberIsSwept) {
  Dataset data = swept();
  EXPECT_FALSE(swept_chart(data, {"none", {.title = "", .label = ""}}));
  data.axes.pop_back();
  for (Dataset::Variable& variable : data.variables) variable.values = Reals(2, 1.0);
  EXPECT_FALSE(swept_chart(data, {"loss", {.title = "", .label = ""}}));
}

TEST(SweptRows, WeighThePointsOfARowAlike) {
  const Axis few{"a", "", "", {1, 2, 3}};
  Axis many{"b", "m", "", {}};
  for (int i = 0; i < 31; ++i) many.values.push_back(i);
  const SweptRows joined({few, many}), apart({many});
  EXPECT_TRUE(joined.joins_points()) << "93 rows would be too many";
  EXPECT_EQ(joined.head(), "b [m]");
  EXPECT_EQ(joined.label({2, 7}), "7");
  using Shares = std::vector<std::uint64_t>;
  EXPECT_EQ(joined.weighed({8, 0}), (Shares{1000, 0}));
  EXPECT_EQ(joined.weighed({30, 90}), (Shares{250, 750}));
  EXPECT_EQ(joined.weighed({0, 0}), (Shares{0, 0}));
  EXPECT_FALSE(apart.joins_points());
  EXPECT_EQ(apart.weighed({30, 90}), (Shares{30, 90}));
}

TEST(SweptMaps, AMapForEachOtherValue) {
  const std::vector<Axis> axes{
      {"a", "", "", {1, 2}}, {"b", "m", "", {1, 2, 3}}, {"c", "", "", {0, 1}, {"x", "y"}}};
  std::vector<MapValue> ratios;
  for (int i = 0; i < 12; ++i) ratios.push_back({i / 100.0, std::to_string(i) + " %"});
  const auto maps = swept_maps(axes, ratios, "Map", "loss");
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(maps[1].title, "Map, y");
  EXPECT_EQ(maps[1].x_label, "b [m]");
  EXPECT_EQ(maps[1].columns, (std::vector<std::string>{"1", "2", "3"}));
  EXPECT_EQ(maps[1].values[1][2], 0.11) << "a = 2, b = 3, c = y";
  EXPECT_EQ(maps[0].values[0][1], 0.02) << "a = 1, b = 2, c = x";
  EXPECT_EQ(maps[1].texts[1][2], "11 %");
}

TEST(SweptMaps, OfOneNumberAndATextWhereThereAreNoTwoNumbers) {
  const std::vector<Axis> axes{{"module", "", "", {0, 1}, {"A", "B"}},
                               {"range", "m", "", {1, 2, 3}}};
  const auto maps = swept_maps(
      axes, {{0, ""}, {0.1, ""}, {0.2, ""}, {0.3, ""}, {0.4, ""}, {0.5, ""}}, "Map", "loss");
  ASSERT_EQ(maps.size(), 1U);
  EXPECT_EQ(maps[0].rows, (std::vector<std::string>{"B", "A"})) << "from below";
  EXPECT_EQ(maps[0].values[0][2], 0.5);
  EXPECT_TRUE(swept_maps({axes[1]}, {{0, ""}, {0, ""}, {0, ""}}, "Map", "loss").empty());
}

TEST(DatasetTable, ARowForEachPointAndElement) {
  const PageTable points =
      dataset_table(swept(),
                    {{"n_runs", "runs"}, {"none", "not there"}, {"loss", "loss"}, {"law", "law"}})
          .value();
  EXPECT_EQ(points.head, (std::vector<std::string>{"presence.detector", "receiver.range_m [m]",
                                                   "runs", "loss", "law"}));
  ASSERT_EQ(points.rows.size(), 5U) << "one was never reached";
  EXPECT_EQ(points.rows[0], (std::vector<std::string>{"goertzel", "1", "4", "< 1.0e-2", "0.01"}));
  EXPECT_EQ(points.rows[4],
            (std::vector<std::string>{"dc", "3", "4", "0.900 [0.800, 0.950]", "-"}));
  const PageTable senders =
      dataset_table(swept(), {{"n_sent", "sent"}, {"age", "age [s]"}}).value();
  EXPECT_EQ(senders.head.at(2), "sender");
  ASSERT_EQ(senders.rows.size(), 10U);
  EXPECT_EQ(senders.rows[3], (std::vector<std::string>{"goertzel", "3", "B", "4", "4"}));
  EXPECT_FALSE(dataset_table(swept(), {{"none", ""}}));
}

TEST(DatasetWords, SayWhereItIsLeastAndGreatest) {
  EXPECT_EQ(
      extremes(swept(), "loss", "Loss", " x"),
      "Loss is least at presence.detector = goertzel, receiver.range_m = 1 m: < 1.0e-2 x, and "
      "greatest at presence.detector = dc, receiver.range_m = 3 m: 0.900 [0.800, 0.950] x.\n");
  EXPECT_EQ(extremes(swept(), "none", "Loss"), "");
  Dataset one;
  one.variables = {{{"age", "s", ""}, true, {}, Reals{1.25}}};
  EXPECT_EQ(extremes(one, "age", "Age", " s"), "Age is 1.25 s.\n");
  Dataset same = swept();
  same.variables[4].values = Reals{2, 2, 2, 2, 2, nan};
  EXPECT_EQ(extremes(same, "law", "It"), "It is 2 at the 5 of 6 points where it is known.\n");
  same.variables[4].values = Reals(6, 2);
  EXPECT_EQ(extremes(same, "law", "It"), "It is 2 at all points.\n");
}

TEST(DatasetWords, CompareByTheUpperEndWhereNothingWasFound) {
  Dataset data = swept();
  data.variables[1].values = Reals(6, 0);
  data.variables[2].values = Reals(6, 0);
  data.variables[3].values = Reals{0.1, 0.1, 0.1, 0.3, 0.1, 0.1};
  EXPECT_EQ(extremes(data, "loss", "Loss"),
            "Loss is least at 5 of 6 points: < 1.0e-1, and greatest at presence.detector = dc, "
            "receiver.range_m = 1 m: < 3.0e-1, which is no clear difference.\n");
}

/// A presence of two points, each with so many trials.
StoredDataset stored_with(const Counts& trials) {
  StoredDataset stored{
      parse_scenario("experiment = \"presence\"\n[presence]\ntrials = 20\n[sweep]\n"
                     "receiver.range_m = [1, 2]\n",
                     "x.toml", {}, {COSYS_SOURCE_DIR "/scenarios"}),
      {}};
  stored.data = dataset_of(stored.scenario, "c");
  stored.data.variables = {{{"n_trials", "1", ""}, true, {}, trials}};
  return stored;
}

TEST(DatasetWords, SayWhatIsMissing) {
  EXPECT_EQ(measured_points(swept()), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(missing_points(stored_with({20, 20})), "");
  EXPECT_EQ(missing_points(stored_with({20, 19})),
            "The run was interrupted: 1 of 2 points were not finished.\n");
  EXPECT_EQ(missing_points(stored_with({5, 0})),
            "The run was interrupted: 2 of 2 points were not finished, 1 of them not begun.\n");
}

TEST(DatasetWords, SayHowManyRuns) {
  Dataset data = swept();
  data.n_runs = 20;
  EXPECT_EQ(runs_text(data), "20 runs at 5 points");
  Dataset one;
  one.n_runs = 1;
  EXPECT_EQ(runs_text(one), "1 run");
}

TEST(DatasetShares, AreOfThePointsThatWereMeasured) {
  const ShareBars bars = point_shares(swept(), "t", "all", {{"n_sent", "sent"}, {"none", "none"}});
  ASSERT_EQ(bars.rows.size(), 5U);
  EXPECT_EQ(bars.rows[1].label, "goertzel, 3");
  EXPECT_EQ(bars.rows[1].counts, (std::vector<std::uint64_t>{7, 0})) << "both senders";
  EXPECT_EQ(bars.kinds, (std::vector<std::string>{"sent", "none"}));
}

TEST(DatasetShares, JoinWhatWouldBeTooManyKinds) {
  const std::vector<std::string> kinds(12, "k");
  const ShareBars bars = point_shares(
      swept(), "t", "all", kinds, [](std::size_t) { return std::vector<std::uint64_t>(12, 1); });
  EXPECT_EQ(bars.kinds.size(), 9U);
  EXPECT_EQ(bars.kinds.back(), "all others");
  EXPECT_EQ(bars.rows.at(0).counts.size(), 9U);
  EXPECT_EQ(bars.rows[0].counts.back(), 4U);
}

TEST(DatasetShares, HaveARowForEachElementOfASinglePoint) {
  Dataset data;
  data.dimensions = swept().dimensions;
  data.variables = {{{"n", "1", ""}, true, {"sender"}, Counts{3, -4}},
                    {{"m", "1", ""}, true, {"sender"}, Reals{nan, 2}}};
  const ShareBars bars = element_shares(data, "t", "all", {{"n", "n"}, {"m", "m"}});
  ASSERT_EQ(bars.rows.size(), 2U);
  EXPECT_EQ(bars.rows[0].label, "A");
  EXPECT_EQ(bars.rows[0].counts, (std::vector<std::uint64_t>{3, 0}));
  EXPECT_EQ(bars.rows[1].counts, (std::vector<std::uint64_t>{0, 2})) << "no count is below 0";
  EXPECT_TRUE(element_shares(data, "t", "all", {{"none", ""}}).rows.empty());
}

TEST(DatasetCells, SumWhatIsKnown) {
  EXPECT_EQ(DatasetCells(swept(), "n_sent").sum(), 55);
  EXPECT_EQ(DatasetCells(swept(), "age").sum(), 55);
  EXPECT_EQ(DatasetCells(swept(), "none").sum(), 0);
  EXPECT_EQ(DatasetCells(swept(), "age").text(11), "-");
  EXPECT_EQ(DatasetCells(swept(), "age").text(99), "-");
}

}  // namespace
}  // namespace sim
