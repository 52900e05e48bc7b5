// What units say together where no frames are lost.
#include "sim/columns/unit_values_text.hpp"

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "gtest/gtest.h"
#include "sim/result/unit_spread.hpp"

namespace sim {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::vector<ColumnFacts> throughput_columns() {
  ColumnFacts runs, throughput, bare;
  runs.facts = {"n_runs", "1", "runs"};
  throughput.facts = {"throughput", "1", "throughput"};
  throughput.heading = {{"through-", "put", "S"}, 8};
  throughput.real_text = fixed(2);
  bare.facts = {"load", "1", "load"};
  return {runs, throughput, bare};
}

/// Two ranges, units 0 to 5 at each; unit 5 was not reached.
Dataset two_ranges() {
  Dataset data;
  data.axes = {{"receiver.range_m", "m", "", {1, 2}}, {unit_key, "1", "", {0, 1, 2, 3, 4, 5}}};
  const auto add = [&](const std::string& name, auto values) {
    data.variables.push_back(
        {.facts = {name, "1", ""}, .dimensions = {}, .values = std::move(values)});
  };
  add("n_runs", std::vector<std::int64_t>{9, 9, 9, 9, 9, 0, 9, 9, 9, 9, 9, 0});
  add("throughput", std::vector<double>{100, 4, 1, 3, 2, 8, 100, 7, unknown, 7, 7, 8});
  add("load", std::vector<double>(12, 1.0));
  return data;
}

TEST(UnitValues, HaveTheirQuantilesAtEachPointOfTheOtherAxes) {
  EXPECT_EQ(unit_value_lines(two_ranges(), throughput_columns()),
            "units drawn within what nobody printed of their parts:\n"
            "  receiver\n"
            "   range_m                              10 %                    90 %\n"
            "       [m]   units  of each         quantile      median    quantile\n"
            "         1       4  throughput S        1.30        2.50        3.70\n"
            "         2       3  throughput S        7.00        7.00        7.00\n");
}

// As presence has a probability for each threshold.
TEST(UnitValues, OfColumnsThatAreSpreadHaveARowForEachElement) {
  ColumnFacts runs, detected;
  runs.facts = {"n_runs", "1", "runs"};
  detected.facts = {"p_detection", "1", "share"};
  detected.over = {"false_alarm"};
  detected.page_heading = "detected";
  detected.spread = [](const Label&, std::size_t) { return TextColumn{{"", "", "x"}, 8}; };
  Dataset data;
  data.axes = {{unit_key, "1", "", {1, 2}}};
  data.dimensions = {{{"false_alarm", "1", ""}, std::vector<double>{0.1, 0.01}}};
  data.variables = {
      {.facts = {"n_runs", "1", ""}, .dimensions = {}, .values = std::vector<std::int64_t>{1, 1}},
      {.facts = {"p_detection", "1", ""},
       .dimensions = {"false_alarm"},
       .values = std::vector<double>{1, 0.25, 0.5, 0.75}}};
  EXPECT_EQ(unit_value_lines(data, {runs, detected}),
            "units drawn within what nobody printed of their parts:\n"
            "                                            10 %                    90 %\n"
            " units  of each                         quantile      median    quantile\n"
            "     2  detected, false_alarm = 0.1         0.55        0.75        0.95\n"
            "     2  detected, false_alarm = 0.01         0.3         0.5         0.7\n");
}

TEST(UnitValues, AreNotSaidTwiceOrOfNoUnits) {
  Dataset data = two_ranges();
  data.axes[1].key = "led.current_ma";
  EXPECT_EQ(unit_value_lines(data, throughput_columns()), "");
  data = two_ranges();
  data.variables[2].facts.name = loss_name;
  EXPECT_EQ(unit_value_lines(data, throughput_columns()), "") << "that is a spread of losses";
}

}  // namespace
}  // namespace sim
