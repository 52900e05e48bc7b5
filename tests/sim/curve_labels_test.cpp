// Names beside curves: over nothing, and nearer to their own curve than to another.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "occurrences.hpp"
#include "one_curve.hpp"
#include "sim/picture/chart.hpp"
#include "sim/picture/curve_labels.hpp"

namespace sim {
namespace {

constexpr PaperBox label_paper{0, 0, 600, 300};

LaidCurve laid_curve(const std::string& name, const std::vector<SvgPoint>& points) {
  LaidCurve curve{name, {}, {}, false};
  for (const SvgPoint& point : points) curve.points.emplace_back(point);
  return curve;
}

/// Where the words are, at 6 pixels a character.
PaperBox box_of_words(const CurveLabel& label, const LaidCurve& curve) {
  const SvgPoint at = anchor_of(label, curve);
  const double wide = 6.0 * static_cast<double>(curve.name.size());
  return {label.is_left ? at.x - wide : at.x, at.y - 10, label.is_left ? at.x : at.x + wide, at.y};
}

SvgPoint box_middle(const PaperBox& box) {
  return {(box.left + box.right) / 2, (box.top + box.bottom) / 2};
}

/// Close points along all lines of a curve.
std::vector<SvgPoint> points_along(const LaidCurve& curve) {
  std::vector<SvgPoint> along;
  for (std::size_t i = 0; i + 1 < curve.points.size(); ++i)
    for (double part = 0; curve.points[i] && curve.points[i + 1] && part <= 1; part += 0.002)
      along.push_back({std::lerp(curve.points[i]->x, curve.points[i + 1]->x, part),
                       std::lerp(curve.points[i]->y, curve.points[i + 1]->y, part)});
  return along;
}

double nearest_of(const std::vector<SvgPoint>& points, const SvgPoint& to) {
  double least = 1e9;
  for (const SvgPoint& p : points) least = std::min(least, std::hypot(p.x - to.x, p.y - to.y));
  return least;
}

bool box_holds(const PaperBox& box, const SvgPoint& point) {
  return point.x > box.left && point.x < box.right && point.y > box.top && point.y < box.bottom;
}

std::vector<LaidCurve> random_curves(std::mt19937& random) {
  std::uniform_real_distribution<double> height(0, 300);
  std::vector<LaidCurve> curves;
  for (int i = 0; i < 3; ++i) {
    std::vector<SvgPoint> points;
    for (double x = 0; x <= 600; x += 100) points.push_back({x, height(random)});
    curves.push_back(laid_curve(fmt::format("curve {}", i), points));
  }
  return curves;
}

TEST(CurveLabels, StandOverNothingAndNearestToTheirOwnCurve) {
  std::mt19937 random(1);
  std::size_t named = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const auto curves = random_curves(random);
    std::vector<PaperBox> taken;
    for (const CurveLabel& label : curve_labels(curves, label_paper)) {
      const PaperBox words = box_of_words(label, curves[label.curve]);
      EXPECT_TRUE(words.left >= 0 && words.right <= 600 && words.top >= 0 && words.bottom <= 300);
      const double own = nearest_of(points_along(curves[label.curve]), box_middle(words));
      for (std::size_t i = 0; i < curves.size(); ++i) {
        const auto along = points_along(curves[i]);
        EXPECT_TRUE(
            std::ranges::none_of(along, [&](const auto& p) { return box_holds(words, p); }));
        if (i != label.curve) EXPECT_GT(nearest_of(along, box_middle(words)), own) << trial;
      }
      for (const PaperBox& other : taken)
        EXPECT_FALSE(words.left < other.right && other.left < words.right &&
                     words.top < other.bottom && other.top < words.bottom);
      taken.push_back(words);
      ++named;
    }
  }
  EXPECT_GT(named, 250U) << "of 300";
}

TEST(CurveLabels, AreLeftOutWhereThereIsNoPlace) {
  std::vector<LaidCurve> curves;
  for (int i = 0; i < 30; ++i)
    curves.push_back(laid_curve(fmt::format("curve {}", i), {{0, 10.0 * i}, {600, 10.0 * i}}));
  for (const CurveLabel& label : curve_labels(curves, label_paper))
    EXPECT_EQ(label.curve, 29U) << "10 pixels are too few for words; below the last there is room";
}

TEST(CurveLabels, KeepIntervalsClear) {
  const LaidCurve bare = laid_curve("c", {{100, 150}, {500, 150}});
  const CurveLabel before = curve_labels({bare}, label_paper).at(0);
  LaidCurve crossed = bare;
  const SvgPoint middle = box_middle(box_of_words(before, bare));
  crossed.intervals.push_back({{middle.x, 0}, {middle.x, 300}});
  EXPECT_NE(curve_labels({crossed}, label_paper).at(0), before);
}

TEST(CurveLabels, DoNotStandWhereACurveIsBroken) {
  LaidCurve curve = laid_curve("c", {{0, 150}, {300, 150}, {600, 150}});
  curve.points[0].reset();
  curve.points[2].reset();
  const CurveLabel label = curve_labels({curve}, label_paper).at(0);
  EXPECT_EQ(label.point, 1U);
  EXPECT_EQ(label.along, 0);
  curve.points[1].reset();
  EXPECT_TRUE(curve_labels({curve}, label_paper).empty());
}

TEST(Chart, NamesSeveralCurvesBesideThem) {
  Chart chart = chart_of({{1, 1, 1, 1}, {2, 1, 1, 1}}, false);
  chart.curves[0].name = "receiver.range_m = 5";
  EXPECT_TRUE(named_places(chart).empty()) << "one alone needs no name";
  chart.curves.push_back({"receiver.range_m = 15", {{1, 9, 9, 9}, {2, 9, 9, 9}}});
  chart.curves.push_back({"receiver.range_m = 15, theory", {{1, 9}, {2, 9}}, CurveKind::theory});
  std::vector<std::string> names;
  for (const NamedPlace& named : named_places(chart)) names.push_back(named.name);
  EXPECT_EQ(names, (std::vector<std::string>{"5", "15"}));
  EXPECT_EQ(occurrences(chart_as_svg(chart), ">15</text>"), 1U);
  chart.curves[1].name = "noise";
  EXPECT_EQ(named_places(chart)[0].name, "receiver.range_m = 5") << "they do not begin alike";
}

TEST(Chart, NamesNoGreyCurve) {
  Chart chart = chart_of({{1, 0, 0, 0}, {2, 0, 0, 0}}, false);
  for (int i = 1; i < 8; ++i) {
    const double y = 10.0 * i;
    chart.curves.push_back({fmt::format("c{}", i), {{1, y, y, y}, {2, y, y, y}}});
  }
  for (const NamedPlace& named : named_places(chart))
    EXPECT_TRUE(colour_of(chart, named.place.curve)) << named.name;
  EXPECT_EQ(named_places(chart).size(), most_coloured);
}

}  // namespace
}  // namespace sim
