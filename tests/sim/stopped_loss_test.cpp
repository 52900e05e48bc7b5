// The frame loss of points that a target may have stopped: its intervals hold the truth at every
// loss ratio, worked out over all ends of counting and not drawn.
#include "sim/counting/stopped_loss.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "sim/result/point_loss.hpp"
#include "tests/sim/held_intervals.hpp"
#include "tests/sim/link_rule.hpp"

namespace {

using sim::Estimate;
using sim::StopRule;
using sim::Tally;

Tally tally_with(std::uint64_t frames, std::uint64_t lost) {
  return {.n_frames = frames, .n_frames_lost = lost};
}

struct End {
  std::uint64_t frames, lost;
};

double binomial(int n, int k, double p) {
  return std::exp(std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1)) *
         std::pow(p, k) * std::pow(1 - p, n - k);
}

/// Every end of counting, with its probability at a loss ratio: by stop_reason() itself.
std::vector<std::pair<End, double>> ends_at(const StopRule& rule, double p) {
  std::vector<std::pair<End, double>> ends;
  std::map<std::uint64_t, double> going_on{{0, 1.0}};
  for (std::uint64_t frames = 8; !going_on.empty(); frames += 8) {
    std::map<std::uint64_t, double> next;
    for (const auto& [lost, probability] : going_on)
      for (int k = 0; k <= 8; ++k)
        next[lost + static_cast<std::uint64_t>(k)] += probability * binomial(8, k, p);
    going_on.clear();
    for (const auto& [lost, probability] : next)
      if (sim::stop_reason(rule, tally_with(frames, lost)))
        ends.push_back({{frames, lost}, probability});
      else
        going_on[lost] = probability;
  }
  return ends;
}

/// The probabilities that an interval misses the truth below and above it.
struct Misses {
  double below = 0, above = 0;
};

Misses misses_at(const StopRule& rule, double p) {
  Misses misses;
  for (const auto& [end, probability] : ends_at(rule, p)) {
    const Estimate loss = sim::stopped_loss(rule, end.frames, end.lost, 0.95);
    if (p < loss.low) misses.below += probability;
    if (p > loss.high) misses.above += probability;
  }
  return misses;
}

void expect_to_hold_everywhere(const StopRule& rule, const std::vector<double>& truths) {
  for (const double p : truths) {
    const Misses misses = misses_at(rule, p);
    EXPECT_LE(misses.below, 0.025 + 1e-6) << p;
    EXPECT_LE(misses.above, 0.025 + 1e-6) << p;
  }
}

TEST(StoppedLoss, HoldsAtEveryLossThatItPromises) {
  expect_to_hold_everywhere({.max_frames = 400, .target_flr = 0.1},
                            {0.02, 0.04, 0.06, 0.08, 0.1, 0.12, 0.14, 0.17, 0.2, 0.3, 0.6});
}

TEST(StoppedLoss, HoldsWhereLossesMayStopItToo) {
  expect_to_hold_everywhere({.max_frames = 400, .max_frame_errors = 20, .target_flr = 0.1},
                            {0.04, 0.07, 0.1, 0.15, 0.2, 0.4});
}

// Of so many frames that nothing was stopped before it is Clopper and Pearson's.
TEST(StoppedLoss, IsThatOfAFixedNumberOfFramesWhereNothingCouldStop) {
  const StopRule rule{.max_frames = 8, .target_flr = 0.01};
  const auto fixed = sim::clopper_pearson(3, 8, 0.95);
  const Estimate loss = sim::stopped_loss(rule, 8, 3, 0.95);
  EXPECT_NEAR(loss.low, fixed.low, 1e-6);
  EXPECT_NEAR(loss.high, fixed.high, 1e-6);
}

TEST(StoppedLoss, EndsAtNothingAndAtAll) {
  const StopRule rule{.max_frames = 5000, .target_flr = 0.01};
  const Estimate none = sim::stopped_loss(rule, 760, 0, 0.95);
  EXPECT_EQ(none.value, 0);
  EXPECT_EQ(none.low, 0);
  EXPECT_NEAR(none.high, sim::clopper_pearson(0, 760, 0.95).high, 1e-6);
  const Estimate all = sim::stopped_loss(rule, 8, 8, 0.95);
  EXPECT_EQ(all.value, 1);
  EXPECT_EQ(all.high, 1);
}

/// The probability at `p` of an end that is `seen` or one of more loss, by a walk of single counts.
double probability_of_more(const StopRule& rule, const End& seen, double p) {
  std::vector<double> going_on{1};
  std::uint64_t least = 0;  // lost, of the first
  double more = 0;
  const auto stops = [&](std::uint64_t frames, std::size_t i) {
    return sim::stop_reason(rule, tally_with(frames, least + i)).has_value();
  };
  for (std::uint64_t frames = 8; frames <= seen.frames; frames += 8) {
    std::vector<double> next(going_on.size() + 8);
    for (int k = 0; k <= 8; ++k) {
      const double probability = binomial(8, k, p);
      double* const to = next.data() + k;
      for (std::size_t i = 0; i < going_on.size(); ++i) to[i] += probability * going_on[i];
    }
    going_on = std::move(next);
    if (frames == seen.frames) break;
    for (; stops(frames, going_on.size() - 1); going_on.pop_back()) more += going_on.back();
    for (; stops(frames, 0); ++least) going_on.erase(going_on.begin());
  }
  for (std::size_t i = 0; i < going_on.size(); ++i)
    if (least + i >= seen.lost) more += going_on[i];
  return more;
}

// Where counts are many they are taken together, and looks too.
TEST(StoppedLoss, ManyCountsTakenTogetherAreAsGoodAsSingleOnes) {
  const StopRule rule{.max_frames = 16000, .target_flr = 0.3};
  for (const std::uint64_t lost : {4680U, 4920U}) {
    const Estimate loss = sim::stopped_loss(rule, 16000, lost, 0.95);
    EXPECT_NEAR(probability_of_more(rule, {16000, lost}, loss.low), 0.025, 0.0005) << lost;
    EXPECT_NEAR(probability_of_more(rule, {16000, lost + 1}, loss.high), 0.975, 0.0005) << lost;
    EXPECT_NEAR(probability_of_more(rule, {16000, lost}, loss.value), 0.5, 0.005) << lost;
  }
}

TEST(StoppedLoss, IsThatOfAPointWithATarget) {
  sim::LinkPoint point{.tally = tally_with(80, 6)};
  EXPECT_EQ(sim::frame_loss_of(point, 0.95).value, 6.0 / 80);
  point.rule = {.max_frames = 5000, .target_flr = 0.01};
  EXPECT_LT(sim::frame_loss_of(point, 0.95).value, 6.0 / 80);
  point.tally = {};
  EXPECT_TRUE(std::isnan(sim::frame_loss_of(point, 0.95).value));
}

/// Losses drawn group by group until the rule stops.
sim::LinkPoint counted_to_stop(const StopRule& rule, double p, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::binomial_distribution<std::uint64_t> lost_of_group(8, p);
  sim::LinkPoint point{.rule = rule};
  while (!sim::stop_reason(rule, point.tally)) {
    point.tally.n_frames += 8;
    point.tally.n_frames_lost += lost_of_group(random);
  }
  return point;
}

TEST(StoppedLoss, MeasuredEstimatesAreAsOftenAboveTheTruthAsBelow) {
  const StopRule rule{.max_frames = 500, .target_flr = 0.1};
  for (const double p : {0.05, 0.07, 0.14, 0.2}) {
    int below = 0;
    for (std::uint64_t seed = 1; seed <= 600; ++seed)
      below += sim::frame_loss_of(counted_to_stop(rule, p, seed), 0.95).value < p;
    EXPECT_NEAR(below / 600.0, 0.5, 0.07) << p;
  }
}

TEST(HeldIntervals, MeasuredOfTargets) {
  const StopRule rule{.max_frames = 5000, .target_flr = 0.01};
  for (const double times : {0.5, 0.7, 1.0, 1.4, 2.0}) {
    const double truth = times * rule.target_flr;
    const auto experiment = [=](std::uint64_t seed) {
      const Estimate loss = sim::frame_loss_of(counted_to_stop(rule, truth, seed), 0.95);
      return held::Printed{loss.low, loss.high, truth};
    };
    held::expect_to_hold(
        {.interval = "frame loss",
         .setting = "--target-flr 0.01 -n 5000, the truth is " + std::to_string(truth).substr(0, 5),
         .gate_seeds = 100},
        experiment);
  }
}

}  // namespace
