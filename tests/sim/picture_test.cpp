// Drawing: places and round values, waveforms without lost spikes, text that stays text, charts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <regex>
#include <set>
#include <string>

#include "occurrences.hpp"
#include "one_curve.hpp"
#include "sim/picture/chart.hpp"
#include "sim/picture/scale.hpp"
#include "sim/picture/svg.hpp"
#include "sim/picture/waveform.hpp"

namespace sim {
namespace {

using Random = std::mt19937_64;

double uniform_real(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

TEST(Scale, PlacesAndValuesUndoEachOther) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Scale scale{uniform_real(random, -9, 0), uniform_real(random, 1, 9),
                      uniform_real(random, 0, 99), uniform_real(random, 100, 999)};
    const double value = uniform_real(random, -20, 20);
    EXPECT_NEAR(scale.value_at(scale(value)), value, 1e-9);
    EXPECT_DOUBLE_EQ(scale(scale.from), scale.at_from);
    EXPECT_NEAR(scale(scale.to), scale.at_to, 1e-9);
  }
}

TEST(RoundValues, AreWithinEvenlyApartAndNotTooMany) {
  Random random(2);
  for (int i = 0; i < 10000; ++i) {
    const double from = uniform_real(random, -1, 1) * std::pow(10, uniform_real(random, -9, 9));
    const double to = from + std::pow(10, uniform_real(random, -9, 9));
    if (!(to - from > 1e-6 * std::abs(from))) continue;
    const int most = std::uniform_int_distribution(2, 20)(random);
    const auto values = round_values(from, to, most);
    ASSERT_LE(values.size(), static_cast<std::size_t>(most));
    ASSERT_GE(values.size() + 2, static_cast<std::size_t>(most) / 3);
    const double slack = 1e-8 * (to - from);
    for (std::size_t k = 0; k < values.size(); ++k) {
      EXPECT_GE(values[k], from - slack);
      EXPECT_LE(values[k], to + slack);
      if (k >= 2) {
        EXPECT_NEAR(values[k] - values[k - 1], values[k - 1] - values[k - 2], slack);
      }
    }
  }
  EXPECT_EQ(round_values(-1, 1, 5), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
  EXPECT_FALSE(std::signbit(round_values(-0.4, 1, 12)[2]));
}

TEST(SampledPath, LosesNoSpikeOfTenMillionSamples) {
  std::vector<float> samples(10'000'000, 0);
  samples[7'654'321] = 3;
  samples[1'234'567] = -2;
  const Scale x{0, 10, 0, 1000}, y{-2, 3, 100, 0};
  const std::string path = sampled_path({samples, 0, 1e-6}, x, y);
  EXPECT_EQ(occurrences(path, "V0.00"), 1U);
  EXPECT_EQ(occurrences(path, "L123.5 100.00"), 1U)
      << "the column of the negative one begins at it";
  EXPECT_EQ(occurrences(path, "V"), 1000U);
}

TEST(SampledPath, GoesFromSampleToSampleWhereThereIsRoom) {
  const std::vector<float> samples{0, 1, 0.5F};
  EXPECT_EQ(sampled_path({samples, 1, 1}, {1, 3.5, 0, 250}, {0, 1, 10, 0}),
            "M0.00 10.00L100.00 0.00L200.00 5.00");
  EXPECT_EQ(sampled_path({samples, 1, 1}, {5, 6, 0, 250}, {0, 1, 10, 0}), "");
}

TEST(WirePath, BeginsAtItsLevelAndTurnsAtEachEdgeOfTheWindow) {
  dsp::LogicTrace wire(true, dsp::Seconds(10));
  for (const double at : {1.0, 2.0, 4.0, 8.0}) wire.add_edge(dsp::Seconds(at));
  EXPECT_EQ(wire_path(wire, {1.5, 6.5, 0, 50}, {0, 1, 10, 0}),
            "M0.00 10.00H5.00V0.00H25.00V10.00H50.00");
  EXPECT_EQ(wire_path(wire, {8, 12, 0, 40}, {0, 1, 10, 0}), "M0.00 0.00H20.00");
}

TEST(SvgDrawing, ShowsTextAsText) {
  SvgDrawing drawing(10, 20, "<script>", "a & b");
  drawing.text({1, 2}, "\"<script>alert(1)</script>\"", "small");
  const std::string text = drawing.finished();
  EXPECT_EQ(text.find("<script"), std::string::npos);
  EXPECT_NE(text.find("&quot;&lt;script&gt;alert(1)&lt;/script&gt;&quot;"), std::string::npos);
  EXPECT_NE(text.find("<desc>a &amp; b</desc>"), std::string::npos);
}

TEST(SvgDrawing, IsLightForPaperAndDarkWhereABrowserIsSetSo) {
  const std::string drawing = SvgDrawing(10, 20, "t", "d").finished();
  EXPECT_EQ(occurrences(drawing, "prefers-color-scheme: dark"), 1U);
  const std::string light = always_light(drawing);
  EXPECT_EQ(occurrences(light, "@media"), 1U) << "that of print";
  EXPECT_EQ(occurrences(light, "@media print"), 1U);
  EXPECT_EQ(occurrences(light, "</style>"), 1U);
  EXPECT_EQ(occurrences(light, "{"), occurrences(light, "}"));
  EXPECT_EQ(always_light(light), light);
}

TEST(Chart, ShowsAPointWithoutErrorsAsALimit) {
  const std::string with =
      chart_as_svg(chart_of({{1, 0, 0, 1e-3, true}, {2, 0.1, 0.05, 0.2}}, true));
  const std::string without = chart_as_svg(chart_of({{2, 0.1, 0.05, 0.2}}, true));
  EXPECT_EQ(occurrences(with, "v24m"), 1U) << "an arrow";
  EXPECT_EQ(occurrences(without, "v24m"), 0U);
  EXPECT_NE(with.find(">1e-3<"), std::string::npos) << "the axis reaches down to the limit";
}

TEST(Chart, ReachesSoFarBelowALimitThatItsArrowHasRoom) {
  const ChartPoint limit{1, 0, 0, 0.1, true}, higher{2, 0.5, 0.4, 0.6};
  const std::string with = chart_as_svg(chart_of({limit, higher}, true));
  EXPECT_NE(with.find(">0.01<"), std::string::npos) << "0.1 is not the foot of the axis";
  EXPECT_EQ(occurrences(with, "v24m"), 1U);
  EXPECT_EQ(chart_as_svg(chart_of({{1, 0.1, 0.1, 0.1}, higher}, true)).find(">0.01<"),
            std::string::npos);
  const std::string linear = chart_as_svg(chart_of({{1, 0, 0, 0.05, true}, {2, 1, 1, 1}}, false));
  EXPECT_EQ(occurrences(linear, "v24m"), 0U) << "it would end below 0";
  EXPECT_EQ(occurrences(linear, "v16.5m"), 1U);
}

TEST(Chart, DrawsItsLevelAcrossClearOfItsEdges) {
  const auto with_level = [](double level, double least) {
    Chart chart = chart_of({{1, least, least, least}, {2, 1, 1, 1}}, true);
    chart.y.level = level;
    return chart_as_svg(chart);
  };
  const std::string drawn = with_level(0.01, 1e-4);
  EXPECT_EQ(occurrences(drawn,
                        "<line class=\"level\" x1=\"80.00\" y1=\"215.00\" x2=\"700.00\" "
                        "y2=\"215.00\"/>"),
            1U)
      << "in the middle of four decades";
  EXPECT_EQ(occurrences(drawn, ">1 %</text>"), 1U);
  for (const double least : {0.01, 0.2, 0.9}) {
    const std::string low = with_level(0.01, least);
    EXPECT_EQ(occurrences(low, "class=\"level\" x1=\"80.00\" y1=\"270.00\""), 1U)
        << "a decade above its foot, of three, where the least is " << least;
    EXPECT_EQ(occurrences(low, ">1e-3</text>"), 1U);
  }
  Chart below = chart_of({{1, 1e-4, 1e-4, 1e-4}, {2, 1e-3, 1e-3, 1e-3}}, true);
  below.y.level = 0.01;
  EXPECT_EQ(occurrences(chart_as_svg(below), "class=\"level\" x1=\"80.00\" y1=\"160.00\""), 1U);
}

TEST(Chart, HasItsFirstAndLastPointOffItsEdges) {
  for (const bool logarithmic : {false, true}) {
    Chart chart = chart_of({{1, 0, 0, 0.1, true}, {2, 1, 1, 1}, {3, 0.5, 0.4, 0.6}}, true);
    chart.x.logarithmic = logarithmic;
    const std::string svg = chart_as_svg(chart);
    EXPECT_EQ(occurrences(svg, "<path class=\"curve1\" d=\"M87.92"), 1U) << "the arrow's head";
    EXPECT_EQ(occurrences(svg, "<path class=\"curve1 dot\" d=\"M688.08"), 1U) << svg;
    EXPECT_EQ(occurrences(svg, "\">1</text>"), 2U) << "marked on both axes";
  }
}

TEST(Chart, HasNoLineOverTheTheoryOfItsPoints) {
  Chart chart = chart_of({{1, 0.1, 0.1, 0.1}, {2, 0.2, 0.2, 0.2}}, true);
  EXPECT_EQ(occurrences(chart_as_svg(chart), "class=\"curve1\""), 2U) << "curve and legend";
  chart.curves.push_back({"theory", chart.curves[0].points, CurveKind::theory});
  const std::string svg = chart_as_svg(chart);
  EXPECT_EQ(occurrences(svg, "class=\"curve1\""), 0U) << svg;
  EXPECT_EQ(occurrences(svg, "class=\"curve1 dot\""), 3U) << "points and legend";
  EXPECT_EQ(occurrences(svg, "class=\"curve1 theory\""), 2U) << "curve and legend";
}

TEST(Chart, DrawsBarsUpFromZero) {
  Chart chart = chart_of({{1, 4, 4, 4}, {2, 2, 2, 2}}, false);
  chart.curves[0].kind = CurveKind::bars;
  chart.y.from_zero = true;
  const std::string svg = chart_as_svg(chart);
  EXPECT_EQ(occurrences(svg,
                        "<rect class=\"fill1\" x=\"210.96\" y=\"50.00\" width=\"60.00\" "
                        "height=\"330.00\"/>"),
            1U)
      << svg;
  EXPECT_EQ(occurrences(svg, "y=\"215.00\" width=\"60.00\" height=\"165.00\"/>"), 1U);
}

TEST(Chart, ReachesDownToZeroWhereToldTo) {
  Chart chart = chart_of({{1, 4, 4, 4}, {2, 5, 5, 5}}, false);
  EXPECT_EQ(occurrences(chart_as_svg(chart), ">0</text>"), 0U);
  chart.y.from_zero = true;
  EXPECT_EQ(occurrences(chart_as_svg(chart), ">0</text>"), 1U);
}

TEST(Chart, MarksTwoDecadesOfItsLowerAxisAtOneTwoAndFive) {
  Chart chart = chart_of({{0.2, 1, 1, 1}, {20, 2, 2, 2}}, false);
  chart.x.logarithmic = true;
  const std::string svg = chart_as_svg(chart);
  for (const char* label : {"0.2", "0.5", "1", "2", "5", "10", "20"})
    EXPECT_GE(occurrences(svg, fmt::format("class=\"middle small\">{}</text>", label)) +
                  occurrences(svg, fmt::format("\">{}</text>", label)),
              1U)
        << label;
  EXPECT_EQ(svg.find(">100</text>"), std::string::npos);
}

TEST(Chart, EndsNoIntervalThatGoesBelowThePaper) {
  const auto ends = [](double low) {
    return occurrences(chart_as_svg(chart_of({{1, 0.5, low, 0.9}, {2, 0.5, 0.5, 0.5}}, true)),
                       "m-4 0h8");
  };
  EXPECT_EQ(ends(0.4), 1U);
  EXPECT_EQ(ends(1e-7), 0U);
}

TEST(Chart, NamesItsLowerAxisInWordsToo) {
  Chart chart = chart_of({{1, 1, 1, 1}}, false);
  EXPECT_EQ(occurrences(chart_as_svg(chart), ">x</text>"), 1U);
  chart.x.words = "distance";
  EXPECT_EQ(occurrences(chart_as_svg(chart), ">distance, x</text>"), 1U);
}

TEST(Chart, MarksCountsAtWholeNumbersAndDistancesBetweenToo) {
  const auto halves = [](bool is_count) {
    Chart chart = chart_of({{1, 0, 0, 0}, {3, 2, 2, 2}}, false);
    chart.y.is_count = is_count;
    return occurrences(chart_as_svg(chart), ">0.5<");
  };
  EXPECT_EQ(halves(true), 0U);
  EXPECT_EQ(halves(false), 1U);
}

TEST(Chart, IsNotMadeFlatByAnIntervalThatGoesFarDown) {
  const std::string text = chart_as_svg(chart_of({{1, 0.1, 1e-9, 0.5}, {2, 0.5, 0.4, 0.6}}, true));
  EXPECT_EQ(text.find(">0.01<"), std::string::npos) << "no decade that no value needs";
  EXPECT_NE(text.find("V380.00"), std::string::npos) << "its bar ends at the lower edge";
}

TEST(Chart, ReachesBeyondTheDecadesOfItsValuesAsFarAsTheirIntervalsDo) {
  const auto ends = [](double low, double high) {
    return chart_as_svg(chart_of({{1, 0.12, low, 0.2}, {2, 0.6, 0.4, high}}, true));
  };
  const std::string within = ends(0.11, 0.9), below = ends(0.06, 0.9), above = ends(0.11, 1.9);
  for (const std::string* each : {&within, &below, &above})
    EXPECT_EQ(occurrences(*each, "m-4 0h8"), 2U) << "both bars are seen whole";
  EXPECT_EQ(occurrences(within, "y2=\"380.00\"/>\n<text class=\"end small\""), 1U);
  EXPECT_EQ(occurrences(below, "y2=\"380.00\"/>\n<text class=\"end small\""), 0U)
      << "it begins at 0.05";
  EXPECT_EQ(below.find(">0.01<"), std::string::npos);
  EXPECT_EQ(above.find(">10<"), std::string::npos);
  EXPECT_EQ(occurrences(above, "M684.08 55.65h8"), 1U) << "1.9 of an axis that ends at 2";
}

TEST(Chart, GivesBarsRoomBesideTheFirstAndTheLastAndTheirIntervals) {
  Chart chart = chart_of({{10, 4, 3, 5}, {30, 2, 2, 2}}, false);
  chart.curves[0].kind = CurveKind::bars;
  chart.y.from_zero = true;
  const std::string svg = chart_as_svg(chart);
  EXPECT_EQ(occurrences(svg, "<rect class=\"fill1\" x=\"210.96\" y=\"116.00\" width=\"60.00\""), 1U)
      << svg;
  EXPECT_EQ(occurrences(svg, "<path class=\"\" d=\"M236.96 50.00h8M240.96 50.00V182.00m-4 0h8\"/>"),
            1U);
}

TEST(Chart, GivesATheoryTheColourOfWhatItIsTheTheoryOf) {
  Chart chart = chart_of({{1, 1, 1, 1}}, false);
  chart.curves.push_back({"c, theory", {}, CurveKind::theory});
  chart.curves.push_back({"d", {}});
  chart.curves.push_back({"d, theory", {}, CurveKind::theory});
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(colour_of(chart, i), i / 2) << i;
  EXPECT_EQ(colour_of({.title = {},
                       .description = {},
                       .x = {},
                       .y = {},
                       .curves = {{"theory alone", {}, CurveKind::theory}}},
                      0),
            0U);
}

Chart chart_of_so_many(int curves) {
  Chart chart = chart_of({}, false);
  chart.curves.clear();
  for (int i = 0; i < curves; ++i) {
    chart.curves.push_back({fmt::format("m{}", i), {{1, 1, 1, 1}, {2, 2, 2, 2}}});
    chart.curves.push_back({fmt::format("m{}, theory", i), {{1, 1}, {2, 2}}, CurveKind::theory});
  }
  return chart;
}

TEST(Chart, GivesSixCurvesAColourEachAndDashesTheoryAlone) {
  Chart chart = chart_of_so_many(6);
  const std::string text = chart_as_svg(chart);
  std::erase_if(chart.curves, [](const ChartCurve& c) { return c.kind == CurveKind::theory; });
  const std::string bare = chart_as_svg(chart);
  for (int colour = 1; colour <= 6; ++colour) {
    EXPECT_EQ(occurrences(bare, fmt::format("<path class=\"curve{}\" d=\"M", colour)), 1U)
        << colour;
    EXPECT_EQ(occurrences(text, fmt::format("<path class=\"curve{} theory\" d=\"M", colour)), 1U);
    EXPECT_EQ(occurrences(text, fmt::format("<path class=\"curve{} dot\" d=\"M", colour)), 3U)
        << "two points, and the legend";
    EXPECT_EQ(occurrences(text, fmt::format(".curve{} {{ stroke: #", colour)),
              colour == 1 ? 2U : 1U)
        << colour << ", and in the dark where it needs another";
  }
  EXPECT_EQ(occurrences(text, "class=\"grey\""), 0U);
}

TEST(Chart, HasGreyCurvesBetweenSixOfMore) {
  const Chart chart = chart_of_so_many(18);
  std::vector<std::size_t> coloured;
  for (std::size_t i = 0; i < 18; ++i) {
    EXPECT_EQ(colour_of(chart, 2 * i), colour_of(chart, 2 * i + 1)) << "a theory is as its curve";
    if (colour_of(chart, 2 * i)) coloured.push_back(i);
  }
  EXPECT_EQ(coloured, (std::vector<std::size_t>{0, 3, 6, 10, 13, 17}));
  const std::string text = chart_as_svg(chart);
  EXPECT_EQ(occurrences(text, "<path class=\"grey\" d=\"M"), 12U);
  EXPECT_EQ(occurrences(text, ">12 more, between these</text>"), 1U);
  EXPECT_EQ(occurrences(text, ">m1</text>"), 0U);
  EXPECT_LT(text.rfind("<path class=\"grey\""), text.find("<path class=\"curve1")) << "below";
}

TEST(Chart, HasOneLineOfItsLegendForSeveralTheories) {
  Chart chart = chart_of({{1, 1, 1, 1}}, false);
  chart.curves.push_back({"law", {{1, 1}}, CurveKind::theory});
  EXPECT_EQ(occurrences(chart_as_svg(chart), ">law</text>"), 1U);
  chart.curves.push_back({"d", {{1, 1}}});
  chart.curves.push_back({"other law", {{1, 1}}, CurveKind::theory});
  const std::string text = chart_as_svg(chart);
  EXPECT_EQ(occurrences(text, "law</text>"), 0U);
  EXPECT_EQ(occurrences(text, ">dashed: theory</text>"), 1U);
  EXPECT_EQ(occurrences(text, "<line class=\"theory\""), 1U);
}

TEST(Chart, StandsOnPaperWhateverItIsGiven) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const bool logarithmic : {false, true})
    for (const auto& points :
         std::vector<std::vector<ChartPoint>>{{},
                                              {{1, nan, nan, nan}},
                                              {{nan, 1, 1, 1}},
                                              {{1, 0, 0, 0}},
                                              {{1, -1, -2, infinity}},
                                              {{1, 1e-300, 0, 1e300}, {1, 5, 5, 5}},
                                              {{1, 1e300, 1e300, 1e300}},
                                              {{1, 1e17, 1e17, 1e17 + 32}}}) {
      const std::string text = chart_as_svg(chart_of(points, logarithmic));
      EXPECT_EQ(text.find("nan"), std::string::npos) << text;
      EXPECT_EQ(text.find("inf"), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace sim
