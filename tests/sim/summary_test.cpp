// The answer on top of a report: how far a link reaches, and what limits it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "lossy_sweep.hpp"
#include "sim/link/validity.hpp"
#include "sim/page/ablations.hpp"
#include "sim/page/link_section.hpp"
#include "sim/page/page.hpp"
#include "sim/page/summary.hpp"

namespace sim {
namespace {

std::string answer_of(const LinkResult& result, const Ablations& ablations) {
  return summary_of(result, rank(result), ablations);
}

TEST(Summary, SaysHowFarTheLinkReachesAndWhatItIsLikeWhereLossBegins) {
  const std::string words = answer_of(sweep_of({point_of(1, 1000, 0), point_of(2, 1000, 0),
                                                point_of(3, 1000, 200), point_of(4, 1000, 1000)}),
                                      {});
  EXPECT_EQ(words.find("4000 frames were simulated at 4 points; 1200 of them were lost.\n"), 0U);
  EXPECT_NE(words.find("\nFrame loss crosses 1 % between receiver.range_m = 2 .. 3 m, two "
                       "neighbours in the sweep.\n"),
            std::string::npos)
      << words;
  EXPECT_NE(
      words.find("\nAt receiver.range_m = 4 m, 100.0 [99.6, 100.0] % of frames are lost; noise is "
                 "26 dB below the signal behind the band-pass.\n"),
      std::string::npos)
      << words;
}

TEST(Summary, OfNoLossNamesNone) {
  const std::string words = answer_of(sweep_of({point_of(1, 1000, 0), point_of(2, 1000, 0)}), {});
  EXPECT_NE(words.find("2000 frames were simulated at 2 points; 0 of them were lost.\n"),
            std::string::npos);
  EXPECT_EQ(words.find("frames are lost;"), std::string::npos) << words;
}

TEST(Summary, OfOnePointGivesTheLossItsInterval) {
  const std::string words = answer_of(sweep_of({point_of(1, 48, 0)}), {});
  EXPECT_EQ(
      words.find("48 frames were simulated; 0 of them were lost: frame loss ratio < 7.4e-2.\n"), 0U)
      << words;
}

TEST(Summary, SaysHowManyPointsHaveNoEstimate) {
  LinkResult result = sweep_of({point_of(1, 48, 20), point_of(2, 48, 4), point_of(3, 48, 1)});
  for (LinkPoint& point : result.points) {  // one of a few runs makes all of the estimate
    point.tally.weighted.n_groups = 6;
    point.tally.weighted.bit_errors = {1, 1, 1, 1};
  }
  const std::string words = answer_of(result, {});
  EXPECT_NE(words.find("\n3 of 3 points have no estimate and are missing in the curves.\n"),
            std::string::npos)
      << words;
  EXPECT_EQ(answer_of(sweep_of({point_of(1, 48, 20)}), {}).find("estimate"), std::string::npos);
}

TEST(Summary, SaysOnWhichSideOfTheSignalNoiseIs) {
  LinkResult result = sweep_of({point_of(1, 1000, 1000)});
  result.points[0].operating.snr_db = -32;
  EXPECT_NE(answer_of(result, {}).find("; noise is 32 dB above the signal "), std::string::npos);
}

/// Modules A, B and so on, each with the loss at 1, 2 and 3 m.
LinkResult modules_of(const std::vector<std::array<std::uint64_t, 3>>& losses) {
  LinkResult result = sweep_of({});
  Axis modules{"receiver.module", "", "", {}};
  for (std::size_t i = 0; i < losses.size(); ++i) {
    modules.values.push_back(static_cast<double>(i));
    modules.labels.emplace_back(1, static_cast<char>('A' + i));
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = static_cast<double>(k) + 1;
      result.points.push_back(point_of(x, 1000, losses[i][k]));
      result.points.back().coordinates = {static_cast<double>(i), x};
    }
  }
  result.axes[0].values = {1, 2, 3};
  result.axes.insert(result.axes.begin(), modules);
  return result;
}

constexpr std::array<std::uint64_t, 3> near{0, 1000, 1000}, far{0, 0, 1000}, dead{1000, 1000, 1000};

TEST(Summary, SaysHowFarEachOfAFewLinksReaches) {
  const std::string words = answer_of(modules_of({near, far, dead}), {});
  EXPECT_NE(words.find("\nFrame loss passes 1 % along receiver.range_m at: receiver.module = B: "
                       "between 2 and 3 m; receiver.module = A: between 1 and 2 m; "
                       "receiver.module = C: short of the sweep: more than 1 % lost in all of 1 .. "
                       "3 m.\nOne point is looked at closer: at receiver.module = "),
            std::string::npos)
      << words;
}

/// The same links as values of a number, which are no parts that one buys.
LinkResult currents_of(const std::vector<std::array<std::uint64_t, 3>>& losses) {
  LinkResult result = modules_of(losses);
  result.axes[0] = {"led.current_ma", "mA", "", result.axes[0].values};
  return result;
}

/// As an interrupted run leaves it: from that point on nothing is counted.
LinkResult counted_before(std::size_t first, LinkResult result) {
  for (std::size_t i = first; i < result.points.size(); ++i) result.points[i].tally = Tally{};
  return result;
}

void expect_says(const LinkResult& result, const std::string& line) {
  const std::string words = answer_of(result, {});
  EXPECT_NE(words.find("\n" + line), std::string::npos) << words;
}

TEST(Summary, NamesTheLinksThatComeFirst) {
  expect_says(modules_of({near, far, near, near, dead}),
              "Of 5 links B (between 2 and 3 m) comes first. How far each reaches is listed "
              "below.\nOne point is looked at closer: at receiver.module = ");
  expect_says(modules_of({far, far, near, near, near}),
              "Of 5 links A (between 2 and 3 m), B (between 2 and 3 m) come first. ");
  expect_says(modules_of({far, far, far, far, far}),
              "5 links. How far each reaches is listed below.\n");
}

TEST(Summary, OfManyValuesOfANumberSaysTheFirstAndTheLast) {
  expect_says(currents_of({far, far, near, near, dead}),
              "First of 5 links: led.current_ma = 0 mA (between 2 and 3 m), led.current_ma = 1 mA "
              "(between 2 and 3 m); last: led.current_ma = 4 mA (short of the sweep: more than 1 % "
              "lost in all of 1 .. 3 m). How far each reaches is listed below.\n");
}

TEST(Summary, ComparesLinksThatAreCountedFarEnoughAlone) {
  expect_says(counted_before(11, modules_of({near, far, near, far, dead})),
              "Of 3 links that are counted far enough (of 5) B (between 2 and 3 m) comes first. ");
  expect_says(counted_before(18, currents_of({far, far, far, far, far, near, near})),
              "First of 6 links that are counted far enough (of 7): 5 of them (between 2 and 3 m); "
              "last: led.current_ma = 5 mA (between 1 and 2 m). ");
}

TEST(Summary, SaysOfALinkThatComesFirstOutsideOfItsModelThatItIs) {
  LinkResult result = modules_of({far, near, near, near, near});
  result.points[0].validity_flags = 1;
  expect_says(result, "Of 5 links A (between 2 and 3 m, outside of what a model is valid for: " +
                          std::string(validity_limits()[0].name) + ") comes first. ");
}

// The first loses 60 % at 2 m, which is nearer to half than what the second ever loses.
TEST(Summary, LooksCloserAtTheLinkThatComesFirst) {
  const LinkResult result = modules_of({{0, 600, 1000}, {0, 0, 900}});
  EXPECT_EQ(failing_point(result)->coordinates, (std::vector<double>{1, 3}));
  const LinkResult alone = modules_of({{0, 600, 1000}});
  EXPECT_EQ(failing_point(alone)->coordinates, (std::vector<double>{0, 2}));
}

Ablation ablation(const std::string& change, std::uint64_t lost) {
  return {change, point_of(0, 100, lost).tally};
}

std::vector<std::string> limit_names(const Ablations& ablations) {
  std::vector<std::string> names;
  for (const Ablation& o : limits_of(ablations)) names.push_back(o.change);
  return names;
}

TEST(Summary, SaysHowMuchFartherTheLinkWouldGo) {
  const LinkResult result = sweep_of({point_of(1, 100, 0), point_of(2, 100, 90)});
  Ablations ablations{"",
                      {ablation("", 90), ablation("without noise", 89),
                       ablation("without the lamp", 3), ablation("without gain", 5)}};
  ablations.along = result.axes[0];
  ablations.ablations[0].half = HalfLoss{HalfLoss::Kind::between, 183.4};
  ablations.ablations[1].half = HalfLoss{HalfLoss::Kind::between, 1.9};
  ablations.ablations[2].half = HalfLoss{HalfLoss::Kind::between, 291.3};
  ablations.ablations[3].half = HalfLoss{HalfLoss::Kind::not_yet, 64};
  EXPECT_EQ(limit_names(ablations), (std::vector<std::string>{"without gain", "without the lamp"}))
      << "what carries farthest comes first";
  EXPECT_NE(answer_of(result, ablations)
                .find("of 100 frames sent again 90 are lost, 5 without gain, 3 without the lamp.\n"
                      "Half of the frames are lost at about receiver.range_m = 180 m as it is, "
                      "beyond 64 m without gain, 290 m without the lamp.\n"),
            std::string::npos)
      << answer_of(result, ablations);
  ablations.ablations[2].half.reset();
  EXPECT_NE(answer_of(result, ablations).find("= 180 m as it is, beyond 64 m without gain.\n"),
            std::string::npos)
      << answer_of(result, ablations);
  const ReportSection part = link_section(link_report_of("file", result, ablations));
  const auto section = std::ranges::find(part.sections, "What limits it", &PageSection::heading);
  ASSERT_NE(section, part.sections.end());
  EXPECT_EQ(section->table->head.size(), section->table->rows[2].size());
  EXPECT_EQ(section->table->rows[1].back(), "1.9");
  EXPECT_EQ(section->table->rows[2].back(), "-");
}

TEST(Summary, NamesWhatTheLossIsClearlyLessWithout) {
  const LinkResult result = sweep_of({point_of(1, 100, 0), point_of(2, 100, 90)});
  const Ablations some{"",
                       {ablation("", 90), ablation("without noise", 85),
                        ablation("without the lamp", 3), ablation("without gain", 60)}};
  EXPECT_EQ(limit_names(some), (std::vector<std::string>{"without the lamp", "without gain"}));
  EXPECT_NE(answer_of(result, some)
                .find("\nWhat limits it there: of 100 frames sent again 90 are "
                      "lost, 3 without the lamp, 60 without gain.\n"),
            std::string::npos);
  const Ablations none{
      "", {ablation("", 90), ablation("without noise", 85), ablation("without gain", 90)}};
  EXPECT_NE(
      answer_of(result, none)
          .find("\nWhat limits it there: nothing alone. Run again without noise, or without gain, "
                "it does not clearly lose less: it is several together, or light too weak for what "
                "the receiver needs.\n"),
      std::string::npos);
}

}  // namespace
}  // namespace sim
