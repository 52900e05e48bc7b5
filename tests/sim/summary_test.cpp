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

std::string top_of(const LinkResult& result, const Ablations& ablations) {
  return answer_of(result, rank(result)) + summary_of(result, ablations);
}

TEST(Summary, SaysHowFarTheLinkReachesAndWhatItIsLikeWhereLossBegins) {
  const std::string words = top_of(sweep_of({point_of(1, 1000, 0), point_of(2, 1000, 0),
                                             point_of(3, 1000, 200), point_of(4, 1000, 1000)}),
                                   {});
  EXPECT_EQ(words.find("The link reaches 2 to 3 m at 1 % frame loss, two neighbours in the "
                       "sweep.\n4000 frames were simulated at 4 points; 1200 of "
                       "them were lost.\n"),
            0U)
      << words;
  EXPECT_NE(
      words.find("\nAt receiver.range_m = 4 m, 100.0 [99.6, 100.0] % of frames are lost; noise is "
                 "26 dB below the signal behind the band-pass.\n"),
      std::string::npos)
      << words;
}

TEST(Summary, OfNoLossNamesNone) {
  const std::string words = top_of(sweep_of({point_of(1, 1000, 0), point_of(2, 1000, 0)}), {});
  EXPECT_NE(words.find("2000 frames were simulated at 2 points; 0 of them were lost.\n"),
            std::string::npos);
  EXPECT_EQ(words.find("frames are lost;"), std::string::npos) << words;
}

TEST(Summary, OfOnePointGivesTheLossItsInterval) {
  const std::string words = top_of(sweep_of({point_of(1, 48, 0)}), {});
  EXPECT_NE(
      words.find("\n48 frames were simulated; 0 of them were lost: frame loss ratio < 7.4e-2.\n"),
      std::string::npos)
      << words;
}

TEST(Summary, SaysHowManyPointsHaveNoEstimate) {
  LinkResult result = sweep_of({point_of(1, 48, 20), point_of(2, 48, 4), point_of(3, 48, 1)});
  for (LinkPoint& point : result.points) {  // one of a few runs makes all of the estimate
    point.tally.weighted.n_groups = 6;
    point.tally.weighted.bit_errors = {1, 1, 1, 1};
  }
  const std::string words = top_of(result, {});
  EXPECT_NE(words.find("\n3 of 3 points have no estimate and are missing in the curves.\n"),
            std::string::npos)
      << words;
  EXPECT_EQ(top_of(sweep_of({point_of(1, 48, 20)}), {}).find("estimate"), std::string::npos);
}

TEST(Summary, SaysOnWhichSideOfTheSignalNoiseIs) {
  LinkResult result = sweep_of({point_of(1, 1000, 1000)});
  result.points[0].operating.snr_db = -32;
  EXPECT_NE(top_of(result, {}).find("; noise is 32 dB above the signal "), std::string::npos);
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

TEST(Summary, BeginsWithTheLinkThatReachesFurthest) {
  const std::string words = top_of(modules_of({near, far, dead}), {});
  EXPECT_EQ(words.find("B reaches furthest: 2 to 3 m at 1 % frame loss; next A, 1 to 2 m; last C, "
                       "less than 1 m.\n9000 frames were simulated"),
            0U)
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
  const std::string words = top_of(result, {});
  EXPECT_EQ(words.find(line), 0U) << words;
}

TEST(Summary, NamesLinksThatStandEqual) {
  expect_says(modules_of({near, far, near, near, dead}),
              "B reaches furthest: 2 to 3 m at 1 % frame loss; next A, C and D, 1 to 2 m; last E, "
              "less than 1 m.\n");
  expect_says(modules_of({far, far, near, near, near}),
              "A and B reach furthest: 2 to 3 m at 1 % frame loss; last C, D and E, 1 to 2 m.\n");
  expect_says(modules_of({far, far, far, far, far}),
              "All 5 links reach 2 to 3 m at 1 % frame loss.\n");
  expect_says(modules_of({far, near, near, near, near}),
              "A reaches furthest: 2 to 3 m at 1 % frame loss; last 4 of 5 links, 1 to 2 m.\n");
}

TEST(Summary, NamesNumbersByTheirKey) {
  expect_says(currents_of({far, near}),
              "led.current_ma = 0 mA reaches furthest: 2 to 3 m at 1 % frame loss; last "
              "led.current_ma = 1 mA, 1 to 2 m.\n");
}

TEST(Summary, ComparesLinksThatAreCountedFarEnoughAlone) {
  const std::string some = top_of(counted_before(11, modules_of({near, far, near, far, dead})), {});
  EXPECT_NE(some.find("\nB reaches furthest: 2 to 3 m at 1 % frame loss; last A and C, 1 to 2 m.\n"
                      "Of 2 more links this cannot be told.\n"),
            std::string::npos)
      << "behind what is missing: " << some;
  const std::string one = top_of(counted_before(3, modules_of({far, near})), {});
  EXPECT_NE(
      one.find("\nA reaches 2 to 3 m at 1 % frame loss.\nOf 1 more link this cannot be told.\n"),
      std::string::npos)
      << one;
}

// A link that needs more of a key, as Eb/N0, is worse.
TEST(Summary, AlongAKeyOfWhichMoreIsBetterTheLeastIsBest) {
  LinkResult result = modules_of({{1000, 0, 0}, {1000, 1000, 0}});
  result.axes[1] = {"receiver.ebn0_db", "dB", "", result.axes[1].values};
  expect_says(result,
              "A needs least of receiver.ebn0_db: 1 to 2 dB at 1 % frame loss; last B, 2 to 3 "
              "dB.\n");
}

TEST(Summary, SaysOfALinkThatComesFirstOutsideOfItsModelThatItIs) {
  LinkResult result = modules_of({far, near, near, near, near});
  result.points[0].validity_flags = 1;
  expect_says(
      result,
      "A reaches furthest: 2 to 3 m at 1 % frame loss (outside of what a model is valid for: " +
          std::string(validity_limits()[0].name) + "); last 4 of 5 links, 1 to 2 m.\n");
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
  EXPECT_NE(top_of(result, ablations)
                .find("of 100 frames sent again 90 are lost, 5 without gain, 3 without the lamp.\n"
                      "Half of the frames are lost at about receiver.range_m = 180 m as it is, "
                      "beyond 64 m without gain, 290 m without the lamp.\n"),
            std::string::npos)
      << top_of(result, ablations);
  ablations.ablations[2].half.reset();
  EXPECT_NE(top_of(result, ablations).find("= 180 m as it is, beyond 64 m without gain.\n"),
            std::string::npos)
      << top_of(result, ablations);
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
  EXPECT_NE(top_of(result, some)
                .find("\nWhat limits it there: of 100 frames sent again 90 are "
                      "lost, 3 without the lamp, 60 without gain.\n"),
            std::string::npos);
  const Ablations none{
      "", {ablation("", 90), ablation("without noise", 85), ablation("without gain", 90)}};
  EXPECT_NE(
      top_of(result, none)
          .find("\nWhat limits it there: nothing alone. Run again without noise, or without gain, "
                "it does not clearly lose less: it is several together, or light too weak for what "
                "the receiver needs.\n"),
      std::string::npos);
}

}  // namespace
}  // namespace sim
