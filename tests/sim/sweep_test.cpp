#include "sim/scenario/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "gtest/gtest.h"
#include "sim/failure.hpp"
#include "sim/text/number_text.hpp"

namespace {

using sim::Axis;

std::vector<double> values_of(const std::string& text) { return sim::parse_values(text, "k in t"); }

std::string refusal_of(const std::string& text) {
  try {
    values_of(text);
  } catch (const sim::Failure& failure) {
    EXPECT_EQ(failure.code(), sim::ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

Axis axis_of(std::size_t n, const std::string& key = "k") {
  Axis axis{key, "1", key, {}};
  for (std::size_t i = 0; i < n; ++i) axis.values.push_back(static_cast<double>(i));
  return axis;
}

TEST(SweepLaw, ARangeEqualsItsValuesTypedOut) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const int decimals = static_cast<int>(random() % 7);
    const long first = static_cast<long>(random() % 20001) - 10000;
    const long n = 1 + static_cast<long>(random() % 200);
    const long step = (1 + static_cast<long>(random() % 50)) * (random() % 2 ? 1 : -1);
    const auto typed = [&](long i) { return fmt::format("{}e-{}", i, decimals); };
    std::string list = typed(first);
    for (long i = 1; i < n; ++i) list += fmt::format(",{}", typed(first + i * step));
    const std::string range =
        fmt::format("{}:{}:{}", typed(first), typed(step), typed(first + (n - 1) * step));
    ASSERT_EQ(values_of(range), values_of(list)) << range;
  }
}

TEST(SweepLaw, NumbersSurviveWritingAndReading) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  for (int trial = 0; trial < 2000; ++trial) {
    const double value = mantissa(random) * std::pow(10, static_cast<int>(random() % 600) - 300);
    ASSERT_EQ(sim::parse_number(fmt::format(" {}\t", value)), value);
  }
}

TEST(SweepLaw, GridVisitsEveryPointOnceLastAxisFastest) {
  const std::vector<Axis> axes{axis_of(3), axis_of(1), axis_of(4)};
  ASSERT_EQ(sim::count_points(axes), 12U);
  std::vector<std::vector<double>> points;
  for (std::size_t i = 0; i < 12; ++i) points.push_back(sim::point_coordinates(axes, i));
  EXPECT_TRUE(std::is_sorted(points.begin(), points.end()));
  EXPECT_EQ(std::set(points.begin(), points.end()).size(), 12U);
  EXPECT_EQ(points[1], (std::vector<double>{0, 0, 1}));
  EXPECT_EQ(sim::count_points({}), 1U);
  EXPECT_TRUE(sim::point_coordinates({}, 0).empty());
}

TEST(Sweep, WrittenForms) {
  EXPECT_EQ(values_of("3"), (std::vector<double>{3}));
  EXPECT_EQ(values_of(" 1, 2 ,+5e0"), (std::vector<double>{1, 2, 5}));
  EXPECT_EQ(values_of("1:1:4"), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(values_of("4:-2:1"), (std::vector<double>{4, 2}));
  EXPECT_EQ(values_of("1:1:3.5"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(values_of("7:1:7"), (std::vector<double>{7}));
  EXPECT_EQ(values_of("-0.2:0.1:0.1"), (std::vector<double>{-0.2, -0.1, 0, 0.1}));
  EXPECT_EQ(values_of("1e5:1e5:3e5"), (std::vector<double>{1e5, 2e5, 3e5}));
  EXPECT_EQ(values_of("0:0.1:1").size(), 11U);
}

TEST(Sweep, NotANumber) {
  for (const char* text :
       {"", " ", "x", "1 2", "0x10", "1_000", "+-1", "++1", "1e", "--1", "1e999"})
    EXPECT_FALSE(sim::parse_number(text)) << text;
}

TEST(Sweep, RefusesInOneLineWithTheReason) {
  const std::string how = " write a:step:b, such as 1:0.5:20, or a list, such as 1,2,5";
  EXPECT_EQ(refusal_of(""), "k in t (no value)" + how);
  EXPECT_EQ(refusal_of("1,,2"), "k in t (\"\" is not a number)" + how);
  EXPECT_EQ(refusal_of("1,2,"), "k in t (\"\" is not a number)" + how);
  EXPECT_EQ(refusal_of("1:2"), "k in t (a range has three numbers)" + how);
  EXPECT_EQ(refusal_of("1:2:3:4"), "k in t (a range has three numbers)" + how);
  EXPECT_EQ(refusal_of("1:0:3"), "k in t (the step is zero)" + how);
  EXPECT_EQ(refusal_of("1:nan:3"), "k in t (not a finite number) write a finite one");
  EXPECT_EQ(refusal_of("1,inf"), "k in t (not a finite number) write a finite one");
  EXPECT_EQ(refusal_of("1:-1:3"),
            "k in t (the step leads away from the end) change the sign of the step");
  EXPECT_EQ(refusal_of("3:1:1"),
            "k in t (the step leads away from the end) change the sign of the step");
}

TEST(Sweep, SizeIsLimitedBeforeMemoryIsTaken) {
  const std::string why = "(more than 1000000 points) use a larger step or fewer axes";
  EXPECT_EQ(values_of("1:1:1000000").size(), sim::most_points);
  EXPECT_EQ(refusal_of("1:1:1000001"), "k in t " + why);
  EXPECT_EQ(refusal_of("0:1e-300:1e300"), "k in t " + why);
  EXPECT_EQ(refusal_of("-1e308:1e-308:1e308"), "k in t " + why);
  EXPECT_EQ(sim::count_points({axis_of(1000), axis_of(1000)}), sim::most_points);
  EXPECT_THROW(sim::count_points({axis_of(1000), axis_of(1001)}), sim::Failure);
  EXPECT_THROW(sim::count_points(std::vector<Axis>(40, axis_of(1000))), sim::Failure);
}

}  // namespace
