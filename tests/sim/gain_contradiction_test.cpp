// Whether trains contradict carriers: outputs of the rule itself, of one part for all steps, or of
// two parts that come back at different rates.
#include "sim/fit/gain_contradiction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "sim/fit/output_rule.hpp"

namespace sim {
namespace {

constexpr double played_hz = 56000;
constexpr double usual_duty = 0.3;

void add(Plan& plan, double dark_ms, PlanStep step) {
  step.start_ms = plan.steps.empty() ? dark_ms : end_ms(plan.steps.back()) + dark_ms;
  plan.steps.push_back(step);
}

/// Carriers, with weaker bursts that tell when the gain is back.
Plan carriers_and_followers() {
  Plan plan;
  for (const double db : {0.0, -8.0, -16.0, -24.0}) {
    add(plan, 2000, {0, played_hz, 50000, 0, 1, db});
    add(plan, 3.5, {0, played_hz, 20, 176, 300, db - 12});
  }
  return plan;
}

void add_trains(Plan& plan) {
  for (const std::uint64_t off : {700u, 550u, 450u, 380u, 320u, 260u, 180u})
    add(plan, 1500, {0, played_hz, 150, off, 80, -34});
}

ParameterPriors priors_of_test() { return parameter_priors({}, played_hz); }

/// A part whose comparator sees light that is 50 dB weaker than the first step's.
Numbers part_of_duty(double share) {
  Numbers x;
  for (const ParameterPrior& prior : priors_of_test()) x.push_back(prior.middle);
  x[place_of(RuleParameter::duty)] = std::log(share);
  return x;
}

std::vector<BurstOutput> bursts_of_rule(const Plan& plan, const Numbers& x) {
  std::vector<double> amplitudes;
  for (const PlanStep& step : plan.steps) amplitudes.push_back(std::pow(10, step.level_db / 20));
  std::vector<BurstOutput> all;
  OutputOfRule rule;
  rule.play(plan, constants_of(x), amplitudes, [&](std::size_t s, bool) {
    std::ranges::copy(rule.bursts(s), std::back_inserter(all));
    return true;
  });
  return all;
}

/// A recording of which trains have a duty of their own.
JoinedLight light_with(const Plan& plan, double duty_of_trains) {
  JoinedLight light{plan, bursts_of_rule(plan, part_of_duty(usual_duty)), {}, {}};
  const std::vector<BurstOutput> of_trains = bursts_of_rule(plan, part_of_duty(duty_of_trains));
  const std::vector<std::size_t> first = first_bursts(plan);
  for (std::size_t s = 0; s < plan.steps.size(); ++s) {
    light.steps.push_back({0, s});
    if (!is_train(plan.steps[s]) || is_behind_carrier(plan, s)) continue;
    for (std::size_t i = first[s]; i < first[s + 1]; ++i) light.recorded[i] = of_trains[i];
  }
  light.captures.push_back({.steps = plan.steps.size()});
  return light;
}

std::optional<FitMisfit> contradiction_at(const JoinedLight& light, double fitted_duty) {
  constexpr double level_error_db = 0.6;
  PlanLikelihood likelihood(light, all_steps_of(light.plan), priors_of_test(), level_error_db);
  Numbers x = likelihood.start();
  x[place_of(RuleParameter::duty)] = std::log(fitted_duty);
  likelihood.take_deviations_at(x);
  return contradiction_of_trains(likelihood, x);
}

TEST(GainContradiction, IsNoneWhereOnePartExplainsAll) {
  Plan plan = carriers_and_followers();
  add_trains(plan);
  EXPECT_FALSE(contradiction_at(light_with(plan, usual_duty), usual_duty));
}

TEST(GainContradiction, NamesTheNumberThatTrainsHaveAnotherValueOf) {
  Plan plan = carriers_and_followers();
  add_trains(plan);
  const auto found = contradiction_at(light_with(plan, 0.42), 0.42);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->what, "carriers and bursts beside trains");
  const std::string head = "alone they have agc_max_duty = ";
  ASSERT_TRUE(found->by_how_much.starts_with(head)) << found->by_how_much;
  EXPECT_NEAR(std::stod(found->by_how_much.substr(head.size())), usual_duty, 0.01);
  EXPECT_NE(found->by_how_much.find(", all steps 0.42 ("), std::string::npos);
}

// Carriers alone, or trains alone: what does not fit them contradicts nothing.
TEST(GainContradiction, NeedsBothKindsOfSteps) {
  const Plan carriers = carriers_and_followers();
  EXPECT_FALSE(contradiction_at(light_with(carriers, usual_duty), 0.42));
  Plan trains;
  add_trains(trains);
  EXPECT_FALSE(contradiction_at(light_with(trains, usual_duty), 0.42));
}

// Bursts at rest say nothing of the gain, so beside them any part would have numbers that are
// likelier beforehand.
TEST(GainContradiction, NeedsCarriers) {
  Plan plan;
  for (const double db : {-30.0, -40.0}) add(plan, 500, {0, played_hz, 30, 2000, 10, db});
  add_trains(plan);
  EXPECT_FALSE(contradiction_at(light_with(plan, 0.004), 0.004));
}

}  // namespace
}  // namespace sim
