// What is made of weighted counts: sums, ratios, stop rules, alarms and comparisons, by hand.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "sim/counting/statistics.hpp"
#include "sim/counting/stop_rule.hpp"
#include "sim/counting/weighted.hpp"
#include "sim/result/alarms.hpp"
#include "sim/result/comparison.hpp"
#include "tests/sim/link_rule.hpp"

namespace sim {
namespace {

TEST(WeightedSum, FollowsItsFormulas) {
  WeightedSum sum = weighted_sum(std::vector<double>{1, 0, 2});
  sum += weighted_sum(std::vector<double>{0, 0, 1});
  EXPECT_EQ(sum.sum, 4);
  EXPECT_NEAR(sum.effective_size(), 16.0 / 6, 1e-12);
  // Groups 3 and 1: mean 2, deviation sqrt 2, of the mean 1.
  EXPECT_NEAR(sum.coefficient_of_variation(2), 0.5, 1e-12);
  EXPECT_FALSE(sum.is_sound());
  WeightedSum even;
  for (int i = 0; i < 30; ++i) even += weighted_sum(std::vector<double>{1});
  EXPECT_TRUE(even.is_sound());
  even += weighted_sum(std::vector<double>{10});
  EXPECT_FALSE(even.is_sound());
}

TEST(WeightedSum, OfNothingVariesNobodyKnowsHow) {
  EXPECT_TRUE(std::isnan(WeightedSum{}.coefficient_of_variation(10)));
  EXPECT_TRUE(std::isnan(WeightedSum{}.coefficient_of_variation(0)));
  EXPECT_TRUE(std::isnan(weighted_sum(std::vector<double>{1}).coefficient_of_variation(1)));
}

/// 25 groups of one run each that lost its frame with these weights in turn.
Tally alternating(double one, double other) {
  Tally tally{.n_bits = 2500, .n_frames = 25};
  tally.weighted.n_groups = 25;
  for (int i = 0; i < 25; ++i) {
    const std::vector<double> weight{i % 2 == 0 ? one : other};
    tally.weighted.frames_lost += weighted_sum(weight);
    tally.weighted.bit_errors += weighted_sum(weight);
  }
  return tally;
}

// 13 of 1 and 12 of 2: mean 1.48, deviation of it 0.5099 / 5 by the sample variance 0.26, which is
// .06890 of the mean; Student's t of 24 degrees has 2.0639 at 97.5 %.
TEST(WeightedRatio, HasALogNormalInterval) {
  const Estimate ratio = bit_error_ratio(alternating(1e-3, 2e-3), 0.95);
  EXPECT_NEAR(ratio.value, 37e-3 / 2500, 1e-12);
  const double width = 2.0639 * std::sqrt(std::log1p(0.06890 * 0.06890));
  EXPECT_NEAR(std::log(ratio.high / ratio.value), width, 2e-4 * width);
  EXPECT_NEAR(std::log(ratio.value / ratio.low), width, 2e-4 * width);
}

// (37e-3)^2 / (13e-6 + 12 * 4e-6) are 22.4 runs; of bit errors here all 25.
TEST(StopRule, TakesTheLesserOfWhatWeightsAreWorth) {
  Tally tally = alternating(1e-3, 2e-3);
  tally.weighted.bit_errors = alternating(1e-3, 1e-3).weighted.bit_errors;
  tally.n_frames_lost = 25;
  EXPECT_NEAR(worth_of_losses(tally), 1369.0 / 61, 1e-9);
  EXPECT_EQ(stop_reason({.max_frame_errors = 22}, tally), StopReason::max_frame_errors);
  EXPECT_EQ(stop_reason({.max_frame_errors = 23}, tally), std::nullopt);
}

TEST(WeightedRatio, IsWithheldWhereAFewRunsMakeIt) {
  Tally tally{.n_bits = 1000, .n_frames = 10};
  tally.weighted.n_groups = 30;
  tally.weighted.bit_errors = weighted_sum(std::vector<double>(30, 1e-9));
  tally.weighted.frames_lost = weighted_sum(std::vector<double>{1e-9});
  EXPECT_DOUBLE_EQ(bit_error_ratio(tally, 0.95).value, 30e-9 / 1000);
  EXPECT_TRUE(std::isnan(frame_loss_ratio(tally, 0.95).value));
  EXPECT_TRUE(std::isnan(undetected_error_ratio(tally, 0.95).value));
}

// Losses of weight 1 in all of 40 frames do not vary; the next frame may be heard all the same.
TEST(WeightedRatio, OfAllFramesIsThatOfFrames) {
  Tally tally{.n_bits = 4000, .n_frames = 40};
  tally.weighted.n_groups = 5;
  for (int i = 0; i < 5; ++i) tally.weighted.frames_lost += weighted_sum(std::vector<double>(8, 1));
  const Estimate loss = frame_loss_ratio(tally, 0.95);
  EXPECT_EQ(loss.high, 1);
  EXPECT_NEAR(loss.low, std::pow(0.025, 1.0 / 40), 1e-12);
}

std::string raised_by(const Tally& tally) {
  std::string names;
  const std::uint64_t mask =
      own_alarms({.operating = {.ebn0_db = 0}, .tally = tally});  // any errors are possible
  for (std::size_t i = 0; i < alarms().size(); ++i)
    if ((mask >> i & 1) != 0) names += std::string(alarms()[i].name) + " ";
  return names;
}

TEST(Alarms, OfWeights) {
  Tally tally{.n_bits = 100, .n_frames = 100};
  tally.weighted.n_groups = 100;
  for (int i = 0; i < 100; ++i) {
    tally.weighted.bit_errors += weighted_sum(std::vector<double>{0.1});
    tally.weighted.frames_lost += weighted_sum(std::vector<double>{0.1});
  }
  EXPECT_EQ(raised_by(tally), "");
  tally.weighted.dark_likelihood = 0.02 * tally.weighted.frames_lost.sum;
  EXPECT_EQ(raised_by(tally), "dark ");
  tally.weighted.dark_likelihood = 0;
  tally.weighted.bit_errors += weighted_sum(std::vector<double>{3});
  EXPECT_EQ(raised_by(tally), "weights ");
}

/// A result of one point.
LinkResult result_of(const Tally& tally) {
  LinkResult result;
  result.points.push_back({.tally = tally});
  return result;
}

/// A loss of `weight` / 2 from 100 groups of one frame, half of them lost.
Tally drawn(double weight) {
  Tally tally{.n_frames = 100};
  tally.weighted.n_groups = 100;
  for (int i = 0; i < 100; ++i)
    tally.weighted.frames_lost += weighted_sum(std::vector<double>{i % 2 == 0 ? weight : 0});
  return tally;
}

double p_value(const Tally& a, const Tally& b) {
  return compare(result_of(a), result_of(b), 0.01).tests[0].p_value;
}

TEST(Comparison, OfAWeightedLossWithACount) {
  EXPECT_EQ(p_value({.n_frames = 10000, .n_frames_lost = 100}, drawn(0.02)), 1);
  EXPECT_EQ(p_value(drawn(0.02), {.n_frames = 10000, .n_frames_lost = 110}), 1);
  EXPECT_LT(p_value({.n_frames = 10000, .n_frames_lost = 400}, drawn(0.02)), 1e-6);
  EXPECT_LT(p_value({.n_frames = 10000}, drawn(0.02)), 1e-6);
  EXPECT_EQ(p_value({.n_frames = 8, .n_frames_lost = 8}, drawn(2)), 1);
}

TEST(Comparison, LeavesOutWhatHasNoEstimate) {
  Tally nothing{.n_frames = 100};
  nothing.weighted.n_groups = 100;
  for (const Tally& other : {Tally{.n_frames = 100, .n_frames_lost = 100}, drawn(0.02)}) {
    const ResultComparison c = compare(result_of(nothing), result_of(other), 0.01);
    EXPECT_TRUE(c.tests.empty());
    EXPECT_EQ(c.unknown, 1u);
  }
}

TEST(Comparison, OfTwoWeightedLosses) {
  EXPECT_NEAR(p_value(drawn(1e-9), drawn(1e-9)), 1, 1e-9);
  EXPECT_LT(p_value(drawn(1e-9), drawn(2e-9)), 1e-4);
  Tally dead{.n_frames = 40};
  dead.weighted.n_groups = 40;
  for (int i = 0; i < 40; ++i) dead.weighted.frames_lost += weighted_sum(std::vector<double>{1});
  EXPECT_NEAR(p_value(dead, dead), 1, 1e-9);
  EXPECT_EQ(p_value(dead, {.n_frames = 8, .n_frames_lost = 8}), 1);
}

}  // namespace
}  // namespace sim
