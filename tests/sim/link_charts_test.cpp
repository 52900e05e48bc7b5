// Curves and maps of a result: which points they have, and what they are called.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/columns/estimate_text.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link_experiment/link_charts.hpp"
#include "sim/section/swept_curves.hpp"

namespace sim {
namespace {

LinkPoint charted_point(std::vector<double> coordinates, std::uint64_t frames, std::uint64_t lost) {
  LinkPoint point{.coordinates = std::move(coordinates)};
  point.tally.n_frames = frames;
  point.tally.n_frames_lost = point.tally.n_bit_errors = lost;
  point.tally.n_frames_ok = frames - lost;
  point.tally.n_bits = 100 * frames;
  point.tally.n_frames_bit_errors = point.tally.sum_bit_errors_squared = lost;
  point.tally.sum_bits_squared = 100 * 100 * frames;
  point.tally.sum_bit_errors_times_bits = 100 * lost;
  return point;
}

TEST(ChartAxis, OfAKeyKnowsWhetherItCounts) {
  EXPECT_TRUE(chart_axis({"devices.crowd.count", "1", "devices", {1, 2}}).is_count);
  EXPECT_FALSE(chart_axis({"receiver.range_m", "m", "distance", {1, 2}}).is_count);
}

TEST(ChartAxis, IsLogarithmicWhereValuesGrowByFactors) {
  const auto is_logarithmic = [](const std::vector<double>& values) {
    return chart_axis({"location.relative_sigma", "1", "", values}).logarithmic;
  };
  EXPECT_TRUE(is_logarithmic({0.01, 0.03, 0.1}));
  EXPECT_TRUE(is_logarithmic({0.1, 0.03, 0.01})) << "in whatever order";
  EXPECT_TRUE(is_logarithmic({1, 2, 5, 10, 20}));
  EXPECT_TRUE(is_logarithmic({1, 2, 4}));
  EXPECT_TRUE(is_logarithmic({0.5, 1, 2, 2.2, 5, 10})) << "over a decade, finer where it fails";
  EXPECT_FALSE(is_logarithmic({1, 2, 2.2, 5})) << "less than a decade";
  EXPECT_TRUE(is_logarithmic({0.001, 1})) << "two decades";
  EXPECT_FALSE(is_logarithmic({1, 20})) << "nothing is known of how two grow";
  EXPECT_FALSE(is_logarithmic({1, 2, 3}));
  EXPECT_FALSE(is_logarithmic({40, 60, 80, 100, 120, 160, 200}));
  EXPECT_FALSE(is_logarithmic({1, 5, 9, 13, 17, 21})) << "even steps over a decade";
  EXPECT_FALSE(is_logarithmic({0, 1, 10, 100}));
  EXPECT_FALSE(is_logarithmic({10, 11, 12.1})) << "too near to each other to crowd";
  EXPECT_FALSE(is_logarithmic({1, 1}));
}

TEST(ResultCharts, HaveLimitsTheoryAndNoPointThatWasNeverReached) {
  LinkResult result;
  result.axes = {{"receiver.ebn0_db", "dB", "energy", {0, 10, 20}}};
  result.points = {charted_point({0}, 10, 5), charted_point({10}, 10, 0),
                   charted_point({20}, 0, 0)};
  result.points[0].operating.ber_theory = 0.04;
  const std::vector<Chart> charts = result_charts(result);
  ASSERT_EQ(charts.size(), 2U);
  EXPECT_EQ(charts[1].title, "Bit errors");
  EXPECT_EQ(charts[0].title, "Frame loss");
  EXPECT_EQ(charts[1].x.label, "receiver.ebn0_db [dB]");
  EXPECT_EQ(title_of(charts[1].x), "energy, receiver.ebn0_db [dB]");
  EXPECT_FALSE(charts[1].y.level);
  EXPECT_EQ(charts[0].y.level, 0.01);
  EXPECT_FALSE(charts[1].x.logarithmic);
  ASSERT_EQ(charts[1].curves.size(), 2U);
  EXPECT_EQ(charts[1].curves[1].name, "theory");
  EXPECT_EQ(charts[1].curves[1].kind, CurveKind::theory);
  EXPECT_EQ(charts[1].curves[1].points.front().y, 0.04);
  ASSERT_EQ(charts[0].curves.size(), 1U);
  const std::vector<ChartPoint>& loss = charts[0].curves[0].points;
  ASSERT_EQ(loss.size(), 2U) << "the third was never reached";
  EXPECT_EQ(loss[0].y, 0.5);
  EXPECT_FALSE(loss[0].is_limit);
  EXPECT_TRUE(loss[1].is_limit);
  EXPECT_GT(loss[1].high, 0.2);
}

TEST(ResultCharts, HaveACurveForEachCombinationOfTheOtherAxes) {
  LinkResult result;
  result.axes = {{"receiver.range_m", "m", "", {0.1, 100, 1000}},
                 {"receiver.module", "", "", {0, 1}, {"A", "B"}}};
  for (const double range : {0.1, 100.0, 1000.0})
    for (const double module : {0, 1})
      result.points.push_back(charted_point({range, module}, 10, 1));
  const Chart chart = result_charts(result)[1];
  EXPECT_TRUE(chart.x.logarithmic) << "over two decades";
  ASSERT_EQ(chart.curves.size(), 2U);
  EXPECT_EQ(chart.curves[1].name, "B");
  EXPECT_EQ(chart.curves[1].points.size(), 3U);
}

// fluorescent.toml sweeps more ballasts than brightnesses, and the answer is a brightness.
TEST(ResultCharts, AreOverTheNumberOfWhichTheAnswerSpeaks) {
  LinkResult result;
  result.axes = {{"disturbance.lamp.ballast_hz", "Hz", "", {25e3, 28e3, 60e3}},
                 {"disturbance.lamp.irradiance_w_per_m2", "W m-2", "", {0.001, 0.05}}};
  for (const double ballast : result.axes[0].values)
    for (const double irradiance : result.axes[1].values)
      result.points.push_back(charted_point({ballast, irradiance}, 10, 1));
  const Chart chart = result_charts(result)[1];
  EXPECT_EQ(chart.x.label, "disturbance.lamp.irradiance_w_per_m2 [W m-2]");
  EXPECT_EQ(chart.curves.size(), 3U);
}

TEST(ResultCharts, AreOverTheWidestWhereTheAnswersNumberStandsStill) {
  LinkResult result;
  result.axes = {{"receiver.range_m", "m", "", {5}}, {"led.current_ma", "mA", "", {10, 20}}};
  for (const double current : {10, 20}) result.points.push_back(charted_point({5, current}, 10, 1));
  EXPECT_EQ(result_charts(result)[1].x.label, "led.current_ma [mA]");
}

// The first curve's theory comes to be known after the second's.
TEST(ResultCharts, TheoryStandsBehindItsOwnCurve) {
  LinkResult result;
  result.axes = {{"device.interval_min_ms", "ms", "", {100, 200}},
                 {"receiver.ebn0_db", "dB", "", {0, 10}}};
  for (const double ebn0 : {0, 10})
    for (const double interval : {100, 200}) {
      result.points.push_back(charted_point({interval, ebn0}, 10, 5));
      if (interval == 200 || ebn0 == 10) result.points.back().operating.ber_theory = 0.04;
    }
  const Chart chart = result_charts(result)[1];
  ASSERT_EQ(chart.curves.size(), 4U);
  for (const std::size_t theory : {1U, 3U}) {
    EXPECT_EQ(chart.curves[theory].kind, CurveKind::theory);
    EXPECT_EQ(chart.curves[theory].name, chart.curves[theory - 1].name + ", theory");
    EXPECT_EQ(colour_of(chart, theory), colour_of(chart, theory - 1));
  }
}

// Tens of units would be tens of curves, of which nobody sees how many carry.
TEST(ResultCharts, OfUnitsSayWhichShareOfThemCarries) {
  LinkResult result;
  result.axes = {{"receiver.unit", "1", "", {0, 1, 2, 3, 4}},
                 {"receiver.range_m", "m", "", {1, 2, 4}}};
  for (const double unit : result.axes[0].values)
    for (const double range : result.axes[1].values)
      result.points.push_back(charted_point({unit, range}, 10, range <= unit ? 0 : 10));
  const std::vector<Chart> charts = result_charts(result);
  ASSERT_EQ(charts.size(), 1U);
  EXPECT_EQ(charts[0].x.label, "receiver.range_m [m]");
  ASSERT_EQ(charts[0].curves.size(), 1U);
  EXPECT_EQ(charts[0].curves[0].name, "units");
  const std::vector<ChartPoint>& shares = charts[0].curves[0].points;
  ASSERT_EQ(shares.size(), 3U);
  EXPECT_EQ(shares[0].y, 1);
  EXPECT_EQ(shares[1].y, 0.75);
  EXPECT_EQ(shares[2].y, 0.25);
  EXPECT_LT(shares[2].low, 0.01);
  EXPECT_GT(shares[2].high, 0.8);
  result.axes.pop_back();
  result.points.resize(5);
  EXPECT_TRUE(result_charts(result).empty()) << "units are no axis";
}

TEST(ResultCharts, OfASinglePointAreNone) {
  LinkResult result;
  result.points = {charted_point({}, 10, 5)};
  EXPECT_TRUE(result_charts(result).empty());
  EXPECT_TRUE(result_maps(result).empty());
}

TEST(ResultMaps, AreOfTheTwoWidestAxesForEachCombinationOfTheOthers) {
  LinkResult result;
  result.axes = {{"receiver.module", "", "", {0, 1}, {"A", "B"}},
                 {"receiver.range_m", "m", "", {1, 2, 3}},
                 {"ambient.daylight_lux", "lx", "", {0, 100}}};
  for (const double module : {0, 1})
    for (const double range : {1, 2, 3})
      for (const double lux : {0, 100}) {
        result.points.push_back(charted_point({module, range, lux}, 10,
                                              module == 1 && range == 3 && lux == 100 ? 4 : 0));
      }
  result.points[1].tally = {};
  const std::vector<HeatMap> maps = result_maps(result);
  ASSERT_EQ(maps.size(), 2U);
  EXPECT_EQ(maps[0].title, "Map of frame loss, A");
  EXPECT_EQ(maps[1].columns, (std::vector<std::string>{"1", "2", "3"}));
  EXPECT_EQ(maps[1].rows, (std::vector<std::string>{"0", "100"}));
  EXPECT_EQ(maps[1].values[1][2], 0.4);
  EXPECT_EQ(maps[1].values[0][2], 0);
  EXPECT_EQ(maps[1].texts[0][2], estimate_text(frame_loss_ratio(result.points[10].tally, 0.95)));
  EXPECT_TRUE(maps[1].texts[0][2].starts_with("< ")) << "none of ten is not none at all";
  EXPECT_TRUE(std::isnan(maps[0].values[1][0]));
}

TEST(ResultMaps, AreInTheOrderOfTheSweepAndNotTooMany) {
  LinkResult result;
  result.axes = {{"device.baud", "Bd", "", {600, 1200}},
                 {"receiver.range_m", "m", "", {1, 2, 3}},
                 {"ambient.daylight_lux", "lx", "", {0, 1, 2}},
                 {"led.current_ma", "mA", "", {20, 100}}};
  for (std::size_t i = 0; i < 2 * 3 * 3 * 2; ++i) result.points.push_back(charted_point({}, 10, 0));
  const std::vector<HeatMap> four = result_maps(result);
  ASSERT_EQ(four.size(), 4U);
  EXPECT_EQ(four[0].title, "Map of frame loss, device.baud = 600, led.current_ma = 20");
  EXPECT_EQ(four[0].description.find("that are shown"), std::string::npos);
  result.axes[0].values = {1, 2};
  result.axes.push_back({"receiver.yaw_deg", "deg", "", {0, 10}});
  result.axes.push_back({"receiver.supply_v", "V", "", {3, 5}});
  for (std::size_t i = 0; i < 36 * 3; ++i) result.points.push_back(charted_point({}, 10, 0));
  const std::vector<HeatMap> first = result_maps(result);
  ASSERT_EQ(first.size(), 12U) << "of 16";
  EXPECT_TRUE(first[11].description.ends_with("; the last of 12 maps that are shown, of 16"))
      << first[11].description;
}

}  // namespace
}  // namespace sim
