#include "sim/fit/gain_contradiction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include "sim/fit/first_search.hpp"
#include "sim/fit/grid_search.hpp"
#include "sim/fit/least_squares.hpp"

namespace sim {
namespace {

using enum RuleParameter;

/// Those of the gain control, but for how far it falls.
constexpr std::array gain_numbers{attack,  duty,      long_burst, free_cycles,
                                  min_gap, dark_hold, margin};

/// A step each: whether it is no train, or one that follows a long carrier.
std::vector<bool> carriers_and_bursts(const Plan& plan) {
  std::vector<bool> are(plan.steps.size());
  for (std::size_t s = 0; s < are.size(); ++s)
    are[s] = !is_train(plan.steps[s]) || is_behind_carrier(plan, s);
  return are;
}

/// Carriers tell of the gain; beside bursts at rest alone trains would contradict what is known
/// beforehand.
bool are_both_kinds(const Plan& plan, const std::vector<bool>& looked_at) {
  return std::ranges::any_of(plan.steps, is_long_carrier) &&
         std::ranges::count(looked_at, false) > 0;
}

LeastSquaresProblem problem_of_gain(PlanLikelihood& likelihood,
                                    const std::vector<bool>& looked_at) {
  std::vector<bool> is_free(likelihood.parameters(), false);
  for (const RuleParameter number : gain_numbers) is_free[place_of(number)] = true;
  LeastSquaresProblem problem = problem_of(likelihood, std::move(is_free));
  problem.visit_deviations = [&likelihood, looked_at](const Numbers& x,
                                                      const std::function<bool(double)>& take) {
    std::size_t feature = 0;
    likelihood.visit_deviations(x, [&](double deviation) {
      return !looked_at[feature++ / n_feature_kinds] || take(deviation);
    });
  };
  return problem;
}

/// From where it is, and from the best of other duties: a jump may hold it.
LeastSquaresFit best_of_duties(const LeastSquaresProblem& problem, const Numbers& x) {
  constexpr std::size_t tried = 3;
  constexpr int iterations = 6;
  const double logarithm = x[place_of(duty)];
  LeastSquaresFit best = least_squares(problem, x, iterations);
  for (const GridPoint& point :
       best_of_grid(problem, x, {{place_of(duty), steps_between(logarithm - 1, logarithm + 1, 41)}},
                    tried)) {
    LeastSquaresFit fit = least_squares(problem, point.x, iterations);
    if (fit.cost < best.cost) best = std::move(fit);
  }
  return best;
}

/// The number that must not be again what it was.
RuleParameter most_needed(const LeastSquaresProblem& problem, const Numbers& before,
                          const Numbers& now) {
  return std::ranges::max(gain_numbers, {}, [&](RuleParameter number) {
    Numbers x = now;
    x[place_of(number)] = before[place_of(number)];
    return cost_of(problem, x);
  });
}

}  // namespace

std::optional<FitMisfit> contradiction_of_trains(PlanLikelihood& likelihood, const Numbers& x) {
  constexpr double much = 28;  // chi squared of 7 numbers: by chance 24.3 in 1 of 1000
  const std::vector<bool> looked_at = carriers_and_bursts(likelihood.plan());
  if (!are_both_kinds(likelihood.plan(), looked_at)) return std::nullopt;
  const LeastSquaresProblem problem = problem_of_gain(likelihood, looked_at);
  const LeastSquaresFit alone = best_of_duties(problem, x);
  const double less = cost_of(problem, x) - alone.cost;
  if (less < much) return std::nullopt;
  const RuleParameter number = most_needed(problem, x, alone.x);
  const std::size_t place = place_of(number);
  return FitMisfit{
      "carriers and bursts beside trains",
      fmt::format("alone they have {} = {:.3g}, all steps {:.3g} (chi squared less by {:.0f})",
                  likelihood.priors()[place].key, value_of(number, alone.x[place]),
                  value_of(number, x[place]), less)};
}

}  // namespace sim
