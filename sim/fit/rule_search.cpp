#include "sim/fit/rule_search.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "sim/fit/least_squares.hpp"

namespace sim {
namespace {

using enum RuleParameter;

/// Short bursts that the gain has nothing to do with: seldom enough, and dark before them.
bool is_short_at_rest(const Plan& plan, std::size_t s) {
  constexpr double longest_cycles = 40, most_duty = 0.08, least_dark_ms = 40;
  const PlanStep& step = plan.steps[s];
  const double on = static_cast<double>(step.cycles_on);
  const double period = on + static_cast<double>(step.cycles_off);
  const double dark_ms = s == 0 ? HUGE_VAL : step.start_ms - end_ms(plan.steps[s - 1]);
  return on <= longest_cycles && dark_ms >= least_dark_ms &&
         (step.repeats == 1 || on / period <= most_duty);
}

template <class Wanted>
std::vector<std::size_t> steps_that(const Plan& plan, Wanted wanted) {
  std::vector<std::size_t> steps;
  for (std::size_t i = 0; i < plan.steps.size(); ++i)
    if (wanted(plan, i)) steps.push_back(i);
  return steps;
}

std::vector<bool> only(std::size_t all, std::initializer_list<RuleParameter> free) {
  std::vector<bool> is_free(all, false);
  for (const RuleParameter one : free) is_free[place_of(one)] = true;
  return is_free;
}

LeastSquaresProblem problem_of(PlanLikelihood& likelihood, std::vector<bool> is_free) {
  return {[&likelihood](const Numbers& x) { return likelihood.deviations(x); }, likelihood.priors(),
          std::move(is_free)};
}

/// A number and the values that a grid has of it.
struct GridAxis {
  RuleParameter number;
  std::vector<double> values;
};

struct GridPoint {
  double cost;
  Numbers x;
};

/// The best points of a grid around `x`, the best first.
std::vector<GridPoint> best_of_grid(const LeastSquaresProblem& problem, const Numbers& x,
                                    const std::vector<GridAxis>& axes, std::size_t wanted) {
  std::size_t all = 1;
  for (const GridAxis& axis : axes) all *= axis.values.size();
  std::vector<GridPoint> points;
  for (std::size_t i = 0; i < all; ++i) {
    Numbers at = x;
    std::size_t rest = i;
    for (const GridAxis& axis : axes) {
      at[place_of(axis.number)] = axis.values[rest % axis.values.size()];
      rest /= axis.values.size();
    }
    points.push_back({cost_of(problem, at), std::move(at)});
  }
  std::ranges::sort(points, {}, &GridPoint::cost);
  points.resize(std::min(points.size(), wanted));
  return points;
}

/// The first of those that lie more than a grid's step or two apart in the threshold or the attack.
std::vector<GridPoint> distinct(const std::vector<GridPoint>& points, std::size_t most) {
  std::vector<GridPoint> chosen;
  for (const GridPoint& point : points) {
    const auto near = [&](const GridPoint& other) {
      return std::abs(point.x[place_of(threshold)] - other.x[place_of(threshold)]) < 5 &&
             std::abs(point.x[place_of(attack)] - other.x[place_of(attack)]) < 0.3;
    };
    if (chosen.size() < most && std::ranges::none_of(chosen, near)) chosen.push_back(point);
  }
  return chosen;
}

std::vector<double> steps_between(double from, double to, int n) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(from + (to - from) * i / (n - 1));
  return values;
}

std::vector<double> logarithms(std::initializer_list<double> values) {
  std::vector<double> all;
  for (const double value : values) all.push_back(std::log(value));
  return all;
}

/// Constants of a stage into those of all steps: its levels are others.
void take(Numbers& x, const Numbers& stage, std::initializer_list<RuleParameter> numbers) {
  for (const RuleParameter number : numbers) x[place_of(number)] = stage[place_of(number)];
}

class RuleSearch {
 public:
  RuleSearch(const Plan& plan, const std::vector<BurstOutput>& recorded,
             const ParameterPriors& priors, double level_error_db)
      : plan_(plan),
        recorded_(recorded),
        priors_(priors),
        level_error_db_(level_error_db),
        all_(plan, recorded, steps_that(plan, [](const Plan&, std::size_t) { return true; }),
             priors, level_error_db),
        x_(all_.start()) {}

  RuleFit operator()() {
    bursts_and_carriers();
    all_steps();
    const LeastSquaresProblem whole = problem_of(all_, std::vector<bool>(all_.parameters(), true));
    return {x_, covariance_at(whole, x_), cost_};
  }

 private:
  /// What the gain's duty has little to do with: threshold, tune, attack and range.
  void bursts_and_carriers() {
    const std::vector<std::size_t> steps = steps_that(plan_, [](const Plan& plan, std::size_t s) {
      return is_short_at_rest(plan, s) || is_long_carrier(plan.steps[s]);
    });
    if (steps.empty()) return;
    PlanLikelihood likelihood(plan_, recorded_, steps, priors_, level_error_db_);
    Numbers x = likelihood.start();
    const auto free =
        only(likelihood.parameters(), {centre, q, threshold, integrator, comparator_hold, attack,
                                       duty, margin, range, start, clock});
    const LeastSquaresProblem problem = problem_of(likelihood, free);
    likelihood.take_wide_deviations();
    auto points = best_of_grid(problem, x,
                               {{threshold, steps_between(-80, -14, 23)},
                                {attack, steps_between(std::log(0.03), std::log(1.6), 20)},
                                {duty, logarithms({0.08, 0.18, 0.4})},
                                {range, {45, 55, 70, 100}}},
                               40);
    points = distinct(points, 4);
    for (GridPoint& point : points) {
      likelihood.take_wide_deviations();
      point.x = least_squares(problem, point.x, 4).x;
      likelihood.take_deviations_at(point.x);
      point.x = least_squares(problem, point.x, 8).x;
      likelihood.take_wide_deviations();
      point.cost = cost_of(problem, point.x);
    }
    const Numbers best = std::ranges::min(points, {}, &GridPoint::cost).x;
    take(x_, best,
         {centre, q, threshold, integrator, comparator_hold, attack, duty, margin, range, start,
          clock});
  }

  void all_steps() {
    std::vector<bool> constants(all_.parameters(), false);
    std::fill(constants.begin(), constants.begin() + n_rule_parameters, true);
    const LeastSquaresProblem few = problem_of(all_, constants);
    const LeastSquaresProblem whole = problem_of(all_, std::vector<bool>(all_.parameters(), true));
    all_.take_wide_deviations();
    std::vector<double> duties = logarithms({0.08, 0.11, 0.15, 0.2, 0.27, 0.35, 0.45});
    duties.push_back(x_[place_of(duty)]);
    auto points = best_of_grid(few, x_,
                               {{duty, duties},
                                {dark_hold, {0, 5, 10, 16, 24}},
                                {long_burst, logarithms({50, 75, 110})},
                                {margin, {0.3, 3}}},
                               4);
    for (GridPoint& point : points) {
      all_.take_deviations_at(point.x);
      point.x = least_squares(few, point.x, 4).x;
      all_.take_wide_deviations();
      point.cost = cost_of(few, point.x);
    }
    x_ = std::ranges::min(points, {}, &GridPoint::cost).x;
    for (int round = 0; round < 2; ++round) {
      all_.take_deviations_at(x_);
      scan_jumps(whole);
      const LeastSquaresFit fit = least_squares(whole, x_, 6);
      x_ = fit.x;
      cost_ = fit.cost;
    }
  }

  /// Numbers with which the output jumps: whole trains are held or not. A difference does not see
  /// what lies behind a jump, so each is tried all along its way.
  void scan_jumps(const LeastSquaresProblem& problem) {
    const double length = x_[place_of(long_burst)], hold = x_[place_of(dark_hold)];
    const std::vector<GridAxis> ways{{long_burst, steps_between(length - 0.5, length + 0.5, 51)},
                                     {min_gap, steps_between(std::log(5), std::log(45), 23)},
                                     {free_cycles, steps_between(0, 32, 17)},
                                     {dark_hold, steps_between(hold - 5, hold + 5, 21)},
                                     {margin, steps_between(0, 8, 17)},
                                     {long_burst, steps_between(length - 0.5, length + 0.5, 51)},
                                     {range, steps_between(40, 130, 31)}};
    for (const GridAxis& way : ways) {
      const GridPoint best = best_of_grid(problem, x_, {way}, 1).front();
      if (best.cost < cost_of(problem, x_)) x_ = best.x;
    }
  }

  const Plan& plan_;
  const std::vector<BurstOutput>& recorded_;
  const ParameterPriors& priors_;
  double level_error_db_;
  PlanLikelihood all_;
  Numbers x_;
  double cost_ = 0;
};

}  // namespace

RuleFit search_rule(const Plan& plan, const std::vector<BurstOutput>& recorded,
                    const ParameterPriors& priors, double level_error_db) {
  return RuleSearch(plan, recorded, priors, level_error_db)();
}

}  // namespace sim
