// How often the place at which a sweep says that the loss passes a level holds the truth, of counts
// drawn from curves that bend.
#include <boost/math/interpolators/makima.hpp>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "held_intervals.hpp"
#include "lossy_sweep.hpp"
#include "sim/engine/search.hpp"
#include "sim/link/theory.hpp"
#include "sim/result/crossing_text.hpp"
#include "tests/sim/link_rule.hpp"

namespace {

using Kind = sim::Crossing::Kind;
using LossCurve = std::function<double(double)>;

struct DrawnSweep {
  LossCurve loss;
  double first, step, last;
  std::uint64_t frames;
  double level = 0.01;
};

double logistic_of(double logit) { return 1 / (1 + std::exp(-logit)); }

/// Where the loss, which rises or falls throughout, passes the level.
double truth_of(const DrawnSweep& sweep) {
  double low = sweep.first, high = sweep.last;
  const bool low_loses = sweep.loss(low) > sweep.level;
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double middle = (low + high) / 2;
    ((sweep.loss(middle) > sweep.level) == low_loses ? low : high) = middle;
  }
  return low;
}

sim::LinkResult drawn(const DrawnSweep& sweep, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<sim::LinkPoint> points;
  const long steps = std::lround((sweep.last - sweep.first) / sweep.step);
  for (long i = 0; i <= steps; ++i) {
    const double x = sweep.first + static_cast<double>(i) * sweep.step;
    std::binomial_distribution<std::uint64_t> lost(sweep.frames, sweep.loss(x));
    points.push_back(sim::point_of(x, sweep.frames, lost(random)));
  }
  return sim::sweep_of(points);
}

/// As it is printed.
held::Printed printed(const sim::Crossing& crossing, const DrawnSweep& sweep) {
  const std::string words =
      sim::crossing_words({"receiver.range_m", "m", "distance", {}}, crossing, false);
  held::Printed ends{NAN, NAN, truth_of(sweep)};
  EXPECT_EQ(std::sscanf(words.c_str(), "%*f [%lf, %lf]", &ends.low, &ends.high), 2) << words;
  return ends;
}

held::Experiment fitted(const DrawnSweep& sweep) {
  return [=](std::uint64_t seed) -> std::optional<held::Printed> {
    const sim::Crossing crossing = sim::frame_loss_crossing(drawn(sweep, seed), sweep.level);
    if (crossing.kind != Kind::fitted) return std::nullopt;
    return printed(crossing, sweep);
  };
}

/// As `find` looks for it, between the ends of the sweep with so many frames a point at most.
sim::LinkResult searched(const DrawnSweep& sweep, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const sim::StopRule rule{.max_frames = sweep.frames, .target_flr = sweep.level};
  std::vector<sim::LinkPoint> points;
  const auto count = [&](double x) -> std::optional<sim::Tally> {
    std::binomial_distribution<std::uint64_t> lost_of_eight(8, sweep.loss(x));
    sim::LinkPoint point = sim::point_of(x, 0, 0);
    while (!sim::stop_reason(rule, point.tally)) {
      point.tally.n_frames += 8;
      point.tally.n_frames_lost += lost_of_eight(random);
    }
    points.push_back(point);
    return point.tally;
  };
  sim::search({sweep.first, sweep.last}, sweep.level, count);
  return sim::sweep_of(points);
}

held::Experiment found(const DrawnSweep& sweep) {
  return [=](std::uint64_t seed) -> std::optional<held::Printed> {
    const sim::Crossing crossing = sim::frame_loss_crossing(searched(sweep, seed), sweep.level);
    if (crossing.kind != Kind::fitted) return std::nullopt;
    return printed(crossing, sweep);
  };
}

held::Experiment bracketed(const DrawnSweep& sweep) {
  return [=](std::uint64_t seed) -> std::optional<held::Printed> {
    const sim::Crossing crossing = sim::frame_loss_crossing(drawn(sweep, seed), sweep.level);
    if (crossing.kind != Kind::bracketed) return std::nullopt;
    return held::Printed{crossing.low, crossing.high, truth_of(sweep)};
  };
}

void expect_fitted_to_hold(const std::string& setting, const DrawnSweep& sweep,
                           double least = 0.93) {
  held::expect_to_hold({"range fitted to a sweep", setting, 8, least, 0.985}, fitted(sweep));
}

/// Of frames of 169 bits in Gaussian noise, along Eb/N0 in dB, as scenarios/theory_decision.toml
/// counts them: 1 % is at 11.706 dB.
double decision_loss(double db) {
  const double ber = sim::coherent_ook_ber(std::pow(10, db / 10));
  return -std::expm1(169 * std::log1p(-ber));
}

/// TSSP4056 of scenarios/quickstart.toml at the end of its reach; logits of 6000 frames a point
/// from 12.1 to 12.5 m, and guessed beyond. 1 % is at 12.21 m.
double tssp_loss(double m) {
  static const boost::math::interpolators::makima<std::vector<double>> logit(
      {11.7, 11.8, 11.9, 12, 12.1, 12.2, 12.3, 12.4, 12.5, 12.6, 12.7},
      {-19, -17, -13.8, -11.5, -8.11, -4.86, -2.54, -0.18, 3.63, 9, 16});
  return logistic_of(logit(m));
}

/// TSOP34856 of scenarios/choose_module.toml: a shoulder of frames that the gain control spoils
/// stands before the cliff. Logits of 3000 frames a point. 1 % is at 1.09 m.
double shoulder_loss(double m) {
  static const boost::math::interpolators::makima<std::vector<double>> logit(
      {0.45, 0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.075, 1.15, 1.2, 1.3, 1.4, 1.6, 1.8, 2, 2.3, 2.4},
      {-13, -11.5, -9.21, -8.11, -6.4, -6.1, -5.6, -4.72, -3.84, -3.28, -2.57, -2.38, -1.76, -1.58,
       2.88, 9, 11});
  return logistic_of(logit(m));
}

/// A Gaussian's tail, of an axis that is not positive.
double gaussian_loss(double x) { return sim::gaussian_q(-x / 2); }

/// Far from the cliff the loss does not fall below 0.4 %.
double floored_loss(double x) { return 0.004 + 0.996 * logistic_of(3 * (x - 10)); }

TEST(HeldIntervals, MeasuredOfARangeInGaussianNoise) {
  expect_fitted_to_hold("decision, 11:0.05:13 dB, -n 1000", {decision_loss, 11, 0.05, 13, 1000});
  expect_fitted_to_hold("decision, 11:0.05:13 dB, -n 3000", {decision_loss, 11, 0.05, 13, 3000});
  expect_fitted_to_hold("decision, 11:0.05:13 dB, -n 200", {decision_loss, 11, 0.05, 13, 200});
  expect_fitted_to_hold("decision, 11:0.05:13 dB, -n 20000", {decision_loss, 11, 0.05, 13, 20000});
  expect_fitted_to_hold("decision, 9:0.1:14 dB, -n 200", {decision_loss, 9, 0.1, 14, 200});
  expect_fitted_to_hold("decision, 9:0.1:14 dB, -n 2000", {decision_loss, 9, 0.1, 14, 2000});
  expect_fitted_to_hold("decision, 8:0.5:15 dB, -n 400", {decision_loss, 8, 0.5, 15, 400});
  expect_fitted_to_hold("decision, 8:1:14 dB, -n 1000", {decision_loss, 8, 1, 14, 1000});
  expect_fitted_to_hold("decision, 10:1:13 dB, -n 1000", {decision_loss, 10, 1, 13, 1000});
  expect_fitted_to_hold("decision, 6:0.25:14 dB, -n 300, 10 %",
                        {decision_loss, 6, 0.25, 14, 300, 0.1});
  expect_fitted_to_hold("decision, 6:0.25:14 dB, -n 300, half lost",
                        {decision_loss, 6, 0.25, 14, 300, 0.5});
}

TEST(HeldIntervals, MeasuredOfARangeAtACliff) {
  expect_fitted_to_hold("TSSP4056, 11.8:0.02:12.6 m, -n 200", {tssp_loss, 11.8, 0.02, 12.6, 200});
  expect_fitted_to_hold("TSSP4056, 11.8:0.02:12.6 m, -n 1000", {tssp_loss, 11.8, 0.02, 12.6, 1000});
  expect_fitted_to_hold("TSSP4056, 11.8:0.02:12.6 m, -n 5000", {tssp_loss, 11.8, 0.02, 12.6, 5000});
  expect_fitted_to_hold("TSSP4056, 11.8:0.1:12.6 m, -n 400", {tssp_loss, 11.8, 0.1, 12.6, 400});
}

TEST(HeldIntervals, MeasuredOfARangeOfOtherShapes) {
  expect_fitted_to_hold("Gaussian tail, -8:0.25:2, -n 1000", {gaussian_loss, -8, 0.25, 2, 1000});
  expect_fitted_to_hold("Gaussian tail, -8:1:4, -n 1000", {gaussian_loss, -8, 1, 4, 1000});
  expect_fitted_to_hold("Gaussian tail, -8:0.25:2, -n 30000", {gaussian_loss, -8, 0.25, 2, 30000});
  expect_fitted_to_hold("TSOP34856, 0.5:0.1:2.3 m, -n 120", {shoulder_loss, 0.5, 0.1, 2.3, 120});
  expect_fitted_to_hold("TSOP34856, 0.5:0.1:2.3 m, -n 400", {shoulder_loss, 0.5, 0.1, 2.3, 400});
  expect_fitted_to_hold("TSOP34856, 0.5:0.1:2.3 m, -n 2000", {shoulder_loss, 0.5, 0.1, 2.3, 2000});
  expect_fitted_to_hold("TSOP34856, 0.6:0.2:2.2 m, -n 400", {shoulder_loss, 0.6, 0.2, 2.2, 400});
  expect_fitted_to_hold("TSOP34856, 0.6:0.2:2.2 m, -n 2000", {shoulder_loss, 0.6, 0.2, 2.2, 2000});
  expect_fitted_to_hold("TSOP34856, 0.7:0.3:1.6 m, -n 1000", {shoulder_loss, 0.7, 0.3, 1.6, 1000});
  // One point or two tell of the floor.
  expect_fitted_to_hold("floor of 0.4 %, 6:1:9, -n 1000", {floored_loss, 6, 1, 9, 1000}, 0.86);
  expect_fitted_to_hold("floor of 0.4 %, 5:0.2:12, -n 1000", {floored_loss, 5, 0.2, 12, 1000});
  expect_fitted_to_hold("floor of 0.4 %, 5:0.2:12, -n 10000", {floored_loss, 5, 0.2, 12, 10000});
}

TEST(HeldIntervals, MeasuredOfARangeThatIsFound) {
  const auto expect_found_to_hold = [](const std::string& setting, const DrawnSweep& sweep) {
    held::expect_to_hold({"range fitted by find", setting, 40, 0.93, 0.985}, found(sweep));
  };
  expect_found_to_hold("decision, 5:15 dB, -n 500", {decision_loss, 5, 0, 15, 500});
  expect_found_to_hold("decision, 5:15 dB", {decision_loss, 5, 0, 15, 5000});
  expect_found_to_hold("decision, 5:15 dB, 10 %, -n 500", {decision_loss, 5, 0, 15, 500, 0.1});
  expect_found_to_hold("TSSP4056, 11.8:12.6 m, -n 500", {tssp_loss, 11.8, 0, 12.6, 500});
  expect_found_to_hold("TSSP4056, 11.8:12.6 m", {tssp_loss, 11.8, 0, 12.6, 5000});
  expect_found_to_hold("floor of 0.4 %, 6:11, -n 2000", {floored_loss, 6, 0, 11, 2000});
  expect_found_to_hold("floor of 0.4 %, 5:12", {floored_loss, 5, 0, 12, 5000});
  expect_found_to_hold("TSOP34856, 0.5:2.3 m", {shoulder_loss, 0.5, 0, 2.3, 5000});
  expect_found_to_hold("TSOP34856, 0.5:2.3 m, -n 500", {shoulder_loss, 0.5, 0, 2.3, 500});
}

// Two tails of 2.5 % by Chernoff's bound, at the points of the sweep: seldom is it wrong at all.
TEST(HeldIntervals, MeasuredOfABracketedRange) {
  held::expect_to_hold(
      {"range bracketed by a sweep", "decision, 10:0.5:13 dB, -n 200", 100, 0.93, 1},
      bracketed({decision_loss, 10, 0.5, 13, 200}));
}

}  // namespace
