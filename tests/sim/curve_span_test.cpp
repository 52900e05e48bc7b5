// Where a curve stays above a value: which stretch is told, and in which words.
#include <gtest/gtest.h>

#include <cmath>

#include "sim/section/curve_span.hpp"

namespace sim {
namespace {

const Axis metres{"x", "m", "", {}};

std::string longest_above_half(const std::vector<double>& values) {
  ChartCurve curve{"", {}};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = static_cast<double>(i + 1);
    curve.points.push_back({x, values[i], values[i], values[i]});
  }
  const std::optional<CurveSpan> span = longest_span(curve, 0.5);
  return span ? in_words(*span, metres) : "nowhere";
}

TEST(CurveSpan, IsTheLongestWithoutAGap) {
  EXPECT_EQ(longest_above_half({0, 1, 0, 1, 1, 1, 0, 1, 0}), "x from 4 to 6 m");
  EXPECT_EQ(longest_above_half({0, 1, 1, std::nan(""), 1, 0}), "x from 2 to 3 m");
}

TEST(CurveSpan, IsNoneWhereNothingReachesThere) {
  EXPECT_EQ(longest_above_half({0, 0.49}), "nowhere");
  EXPECT_EQ(longest_above_half({}), "nowhere");
  EXPECT_EQ(longest_above_half({0, 0.5, 0}), "x = 2 m");
}

TEST(CurveSpan, SaysWhereTheSweepEndedIt) {
  EXPECT_EQ(longest_above_half({1, 1, 0}), "x from 1, where the sweep begins, to 2 m");
  EXPECT_EQ(longest_above_half({0, 1, 1}), "x from 2 to 3 m, where the sweep ends");
}

TEST(CurveSpan, SaysWhichCurveItIs) {
  ChartCurve curve{"A", {{1, 0, 0, 0}, {2, 1, 1, 1}, {3, 0, 0, 0}}};
  EXPECT_EQ(in_words(longest_span(curve, 0.5).value(), metres), "x = 2 m (A)");
}

}  // namespace
}  // namespace sim
