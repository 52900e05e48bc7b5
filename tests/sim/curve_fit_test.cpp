#include "sim/result/curve_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace {

using Kind = sim::Crossing::Kind;

void add_point(sim::ExperimentResult& result, double x, std::uint64_t lost, std::uint64_t frames) {
  sim::PointResult point{.coordinates = {x}};
  point.tally.n_frames = frames;
  point.tally.n_frames_lost = lost;
  result.axes[0].values.push_back(x);
  result.points.push_back(point);
}

sim::ExperimentResult sweep(const std::vector<double>& at, const std::vector<std::uint64_t>& lost,
                            std::uint64_t frames = 1000) {
  sim::ExperimentResult result;
  result.axes = {{"receiver.range_m", "m", "distance", {}}};
  for (std::size_t i = 0; i < at.size(); ++i) add_point(result, at[i], lost[i], frames);
  return result;
}

using Loss = std::function<double(double)>;

sim::ExperimentResult drawn(const std::vector<double>& at, const Loss& loss, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<std::uint64_t> lost;
  for (const double x : at) {
    std::binomial_distribution<std::uint64_t> draw(2000, loss(x));
    lost.push_back(draw(random));
  }
  return sweep(at, lost, 2000);
}

double logistic(double t) { return 1 / (1 + std::exp(-t)); }

const std::vector<double> ranges{5, 6, 7, 8, 9, 10, 11, 12};

double loss_over_range(double x) { return logistic(12 * std::log(x / 10)); }

TEST(Crossing, IntervalCoversTheTruth) {
  const double truth = 10 * std::exp(std::log(0.01 / 0.99) / 12);
  int covered = 0;
  double mean = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    const auto c = sim::frame_loss_crossing(drawn(ranges, loss_over_range, seed));
    ASSERT_EQ(c.kind, Kind::fitted) << seed;
    covered += c.low <= truth && truth <= c.high;
    mean += c.at / 400;
  }
  EXPECT_NEAR(mean, truth, 0.02);
  EXPECT_GE(covered, 370);  // 380 expected of 400, standard deviation 4.4
  EXPECT_LE(covered, 395);
}

TEST(Crossing, FindsAnyLevel) {
  const auto result = drawn(ranges, loss_over_range, 1);
  EXPECT_NEAR(sim::frame_loss_crossing(result, 0.5).at, 10, 0.1);
  EXPECT_NEAR(sim::frame_loss_crossing(result, 0.1).at, 10 * std::exp(std::log(1. / 9) / 12), 0.1);
}

TEST(Crossing, UsesTheAxisItselfWhereItIsNotPositive) {
  const std::vector<double> levels{-10, -5, 0, 5, 10};
  const auto loss = [](double x) { return logistic(0.5 * x); };
  const auto c = sim::frame_loss_crossing(drawn(levels, loss, 2));
  ASSERT_EQ(c.kind, Kind::fitted);
  EXPECT_NEAR(c.at, 2 * std::log(0.01 / 0.99), 0.5);
}

TEST(Crossing, IsTheSameForALossThatFallsAlongTheAxis) {
  const auto falling = [](double x) { return logistic(12 * std::log(10 / x)); };
  const std::vector<double> currents{8, 9, 10, 12, 14, 16, 18, 20};
  const auto c = sim::frame_loss_crossing(drawn(currents, falling, 3));
  ASSERT_EQ(c.kind, Kind::fitted);
  EXPECT_NEAR(c.at, 10 * std::exp(-std::log(0.01 / 0.99) / 12), 0.3);
  EXPECT_LT(c.low, c.at);
  EXPECT_GT(c.high, c.at);
}

TEST(Crossing, BracketsAJump) {
  for (const std::uint64_t between : {std::uint64_t{1000}, std::uint64_t{300}}) {
    const auto c = sim::frame_loss_crossing(sweep({1, 2, 3, 4}, {0, 0, between, 1000}));
    EXPECT_EQ(c.kind, Kind::jump);
    EXPECT_EQ(c.low, 2);
    EXPECT_EQ(c.high, 3);
  }
  const auto falling = sim::frame_loss_crossing(sweep({1, 2, 3, 4}, {1000, 1000, 0, 0}));
  EXPECT_EQ(falling.kind, Kind::jump);
  EXPECT_EQ(falling.low, 2);
  EXPECT_EQ(falling.high, 3);
}

TEST(Crossing, SaysWhenThereIsNone) {
  const auto below = sim::frame_loss_crossing(sweep({1, 3, 2}, {0, 10, 0}));
  EXPECT_EQ(below.kind, Kind::all_below);  // 1 % is not above 1 %
  EXPECT_EQ(below.low, 1);
  EXPECT_EQ(below.high, 3);
  EXPECT_NEAR(below.bound, 0.0183, 1e-4);  // Clopper-Pearson's upper end of 10 in 1000
  const auto above = sim::frame_loss_crossing(sweep({3, 1, 2}, {1000, 11, 800}));
  EXPECT_EQ(above.kind, Kind::all_above);
  EXPECT_EQ(above.low, 1);
  EXPECT_EQ(above.high, 3);
  EXPECT_EQ(sim::frame_loss_crossing(sweep({}, {})).kind, Kind::unclear);
  // 0.9 % and 1.1 % of 1000 frames: on both sides of the level, but not told apart.
  EXPECT_EQ(sim::frame_loss_crossing(sweep({1, 2, 3}, {9, 10, 11})).kind, Kind::unclear);
}

TEST(Crossing, SaysWhenTheLossIsNotMonotone) {
  const auto overdriven = sweep({0.01, 0.1, 1, 10}, {200, 0, 0, 1000});
  EXPECT_EQ(sim::frame_loss_crossing(overdriven).kind, Kind::not_monotone);
  EXPECT_EQ(sim::frame_loss_crossing(sweep({1, 2, 3}, {0, 500, 0})).kind, Kind::not_monotone);
}

TEST(Crossing, BracketsWhatNoLogitFits) {
  const auto plateau = sweep({1, 2, 3, 4, 5, 6, 7}, {0, 100, 100, 100, 100, 100, 1000});
  const auto c = sim::frame_loss_crossing(plateau);
  EXPECT_EQ(c.kind, Kind::unfitted);
  EXPECT_EQ(c.low, 1);
  EXPECT_EQ(c.high, 2);
  // 24 frames a point: none lost is no proof of less than 1 %, but the step is plain to see.
  const auto few = sim::frame_loss_crossing(sweep({1, 2, 3, 4, 5}, {0, 0, 23, 21, 24}, 24));
  EXPECT_EQ(few.kind, Kind::unfitted);
  EXPECT_EQ(few.low, 2);
  EXPECT_EQ(few.high, 3);
}

// One of 40 frames is no crossing, on whichever side of the others it falls.
TEST(Crossing, IsNotSeenInNoise) {
  EXPECT_EQ(sim::frame_loss_crossing(sweep({1, 2, 3}, {1, 0, 0}, 40)).kind, Kind::unclear);
  EXPECT_EQ(sim::frame_loss_crossing(sweep({1, 2, 3}, {0, 0, 1}, 40)).kind, Kind::unclear);
  const auto above = sim::frame_loss_crossing(sweep({1, 2, 3}, {2, 1, 1}, 40));
  EXPECT_EQ(above.kind, Kind::all_above);
  EXPECT_NEAR(above.bound, 6.3e-4, 1e-5);  // Clopper-Pearson's lower end of 1 in 40
}

// The fit, drawn by the steep end, would put the crossing at 7.8, behind points that surely lose
// more than that.
TEST(Crossing, DoesNotContradictAPoint) {
  const auto shoulder = sweep(ranges, {0, 0, 29, 43, 46, 87, 773, 800});
  const auto c = sim::frame_loss_crossing(shoulder);
  EXPECT_EQ(c.kind, Kind::unfitted);
  EXPECT_EQ(c.low, 6);
  EXPECT_EQ(c.high, 7);
}

TEST(Crossing, LeavesOutPointsNeverReached) {
  auto result = drawn(ranges, loss_over_range, 5);
  const auto all = sim::frame_loss_crossing(result);
  add_point(result, 13, 0, 0);
  const auto fewer = sim::frame_loss_crossing(result);
  EXPECT_EQ(fewer.kind, Kind::fitted);
  EXPECT_EQ(fewer.at, all.at);
}

TEST(CrossingSentence, SaysEachOutcome) {
  const sim::Axis axis{"receiver.range_m", "m", "distance", {1, 10}};
  const auto say = [&](sim::Crossing c) { return sim::crossing_sentence(axis, c); };
  EXPECT_EQ(say({Kind::fitted, 7.88, 7.6, 8.2}),
            "frame loss crosses 1 % at receiver.range_m = 7.9 [7.6, 8.2] m");
  EXPECT_EQ(say({Kind::fitted, 78.8, 65, 91}),
            "frame loss crosses 1 % at receiver.range_m = 79 [65, 91] m");
  EXPECT_EQ(say({Kind::jump, 7.5, 7, 8, 0.003}),
            "frame loss crosses 1 % between receiver.range_m = 7 .. 8 m (no point lies between)");
  EXPECT_EQ(say({Kind::jump, 7.5, 7, 8, 0.018}),
            "frame loss crosses 1 % between receiver.range_m = 7 .. 8 m (no point lies "
            "between, though 1.8 % cannot be ruled out before them)");
  EXPECT_EQ(say({Kind::unfitted, 7.5, 7, 8}),
            "frame loss crosses 1 % between receiver.range_m = 7 .. 8 m "
            "(no logit curve fits the points)");
  EXPECT_EQ(say({Kind::all_below, 3, 1, 5}),
            "frame loss stays at most 1 % over receiver.range_m = 1 .. 5 m");
  EXPECT_EQ(say({Kind::all_below, 3, 1, 5, 0.0377}),
            "frame loss is seen to stay at most 1 % over receiver.range_m = 1 .. 5 m, though "
            "3.8 % cannot be ruled out");
  EXPECT_EQ(say({Kind::all_above, 1, 1, 1, 0.02}),
            "frame loss is above 1 % over receiver.range_m = 1 m");
  EXPECT_EQ(say({Kind::unclear}),
            "frame loss does not clearly cross 1 % inside the sweep of receiver.range_m");
  EXPECT_EQ(say({Kind::not_monotone}),
            "frame loss rises and falls along receiver.range_m: no single crossing of 1 %");
}

TEST(PlaceText, HasEachAxisWithItsUnit) {
  const std::vector<sim::Axis> axes{
      {"receiver.range_m", "m", "distance", {2.2, 10}},
      {"receiver.module", "", "module", {0, 1}, {"TSSP4056", "TSOP4856"}},
      {"noise.scale", "1", "noise", {0.5}}};
  EXPECT_EQ(sim::place_text(axes, {2.2, 1, 0.5}),
            "receiver.range_m = 2.2 m, receiver.module = TSOP4856, noise.scale = 0.5");
  EXPECT_EQ(sim::place_text({}, {}), "");
}

TEST(CrossingWords, SayEachOutcomeInAList) {
  const sim::Axis axis{"receiver.range_m", "m", "distance", {1, 10}};
  const auto say = [&](sim::Crossing c) { return sim::crossing_words(axis, c); };
  EXPECT_EQ(say({Kind::fitted, 7.88, 7.6, 8.2}), "7.9 [7.6, 8.2] m");
  EXPECT_EQ(say({Kind::jump, 7.5, 7, 8, 0.003}), "between 7 and 8 m");
  EXPECT_EQ(say({Kind::unfitted, 7.5, 7, 8}), "between 7 and 8 m (no logit curve fits the points)");
  EXPECT_EQ(say({Kind::all_below, 3, 1, 5}), "beyond the sweep: at most 1 % lost in 1 .. 5 m");
  EXPECT_EQ(say({Kind::all_below, 3, 1, 5, 0.0377}),
            "beyond the sweep: at most 1 % lost in 1 .. 5 m, though 3.8 % cannot be ruled out");
  EXPECT_EQ(say({Kind::all_above, 3, 1, 5, 0.02}),
            "short of the sweep: more than 1 % lost in all of 1 .. 5 m");
  EXPECT_EQ(
      say({Kind::all_above, 3, 1, 5, 0.0013}),
      "short of the sweep: more than 1 % lost in all of 1 .. 5 m, though 0.13 % cannot be ruled "
      "out");
  EXPECT_EQ(say({Kind::not_monotone}), "loss rises and falls: no single value, see the table");
  EXPECT_EQ(say({}), "unclear: too few frames to tell its side of 1 %");
}

}  // namespace
