#include "sim/fit/first_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "sim/fit/grid_search.hpp"
#include "sim/fit/profile_search.hpp"

namespace sim {
namespace {

using enum RuleParameter;

/// What threshold, tune, attack and range show in, and the gain's duty hardly; of one capture.
std::vector<std::size_t> bursts_and_carriers_of(const JoinedLight& light, std::size_t capture) {
  std::vector<std::size_t> steps = all_steps_of(light.plan);
  std::erase_if(steps, [&](std::size_t s) {
    return light.steps[s].capture != capture || !is_burst_or_carrier(light.plan, s);
  });
  return steps;
}

/// What they tell.
constexpr std::array numbers_of_first_steps{
    centre, q, threshold, integrator, comparator_hold, attack, duty, margin, range, start, clock};

std::vector<bool> numbers_told(const PlanLikelihood& likelihood) {
  std::vector<bool> told(likelihood.parameters(), false);
  for (const RuleParameter one : numbers_of_first_steps) told[place_of(one)] = true;
  return told;
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

class FirstSearch {
 public:
  FirstSearch(const JoinedLight& light, const ParameterPriors& priors, double level_error_db)
      : light_(light), priors_(priors), level_error_db_(level_error_db) {}

  Numbers operator()() {
    PlanLikelihood first = likelihood_of(0);
    x_ = first.start();
    if (!first.plan().steps.empty()) {
      find_constants(first);
      find_levels(first);
    }
    for (std::size_t k = 1; k < light_.captures.size(); ++k) find_light_of(k);
    return x_;
  }

 private:
  PlanLikelihood likelihood_of(std::size_t capture) const {
    return {light_, bursts_and_carriers_of(light_, capture), priors_, level_error_db_};
  }

  /// The first capture tells the constants.
  void find_constants(PlanLikelihood& likelihood) {
    const LeastSquaresProblem problem = problem_of(likelihood, numbers_told(likelihood));
    likelihood.take_wide_deviations();
    auto points =
        best_of_grid(problem, likelihood.start(),
                     {{place_of(threshold), steps_between(-80, -14, 23)},
                      {place_of(attack), steps_between(std::log(0.03), std::log(1.6), 20)},
                      {place_of(duty), logarithms({0.08, 0.18, 0.4})},
                      {place_of(range), {45, 55, 70, 100}}},
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
    for (const RuleParameter one : numbers_of_first_steps) x_[place_of(one)] = best[place_of(one)];
  }

  /// Bursts near Emin are all reported, or none of them, so a difference sees neither that Emin nor
  /// that a level is another one: Emin is tried as far off as levels are, each time with the levels
  /// that go best with it.
  void find_levels(PlanLikelihood& likelihood) {
    constexpr std::uint64_t most_bursts = 15'000'000;
    const std::vector<bool> constants = numbers_told(likelihood);
    std::vector<bool> is_free = constants;
    std::fill(is_free.begin() + static_cast<std::ptrdiff_t>(likelihood.before_levels()),
              is_free.end(), true);
    const LeastSquaresProblem problem = problem_of(likelihood, is_free);
    likelihood.take_deviations_at(x_);
    LeastSquaresFit best{x_, HUGE_VAL};
    for (const double off_db : steps_between(-1.5, 1.5, 13)) {
      Numbers x = x_;
      x[place_of(threshold)] += off_db;
      x = best_of_each_level(problem, x, likelihood.before_levels());
      LeastSquaresFit fit = least_squares(problem, x, 4);
      if (fit.cost < best.cost) best = std::move(fit);
    }
    likelihood.take_deviations_at(best.x);
    x_ = profile_search(problem, best.x, constants,
                        [&] { return likelihood.bursts_played() < most_bursts; });
  }

  /// Each other one how strong its light is against the first one's; and how far the gain falls,
  /// where it is stronger.
  void find_light_of(std::size_t capture) {
    PlanLikelihood likelihood = likelihood_of(capture);
    if (likelihood.plan().steps.empty()) return;
    const std::size_t level = place_of(CaptureNumber::level, capture);
    const ParameterPrior& prior = likelihood.priors()[level];
    const double reach = 3 * prior.deviation;
    std::vector<bool> is_free(likelihood.parameters(), false);
    for (const CaptureNumber one :
         {CaptureNumber::start, CaptureNumber::clock, CaptureNumber::level})
      is_free[place_of(one, capture)] = true;
    std::vector<double> ranges = steps_between(45, 120, 11);
    ranges.push_back(x_[place_of(range)]);
    const LeastSquaresProblem problem = problem_of(likelihood, is_free);
    likelihood.take_wide_deviations();
    x_ = best_of_grid(problem, x_,
                      {{level, steps_between(prior.middle - reach, prior.middle + reach, 61)},
                       {place_of(range), ranges}},
                      1)
             .front()
             .x;
    x_ = least_squares(problem, x_, 6).x;
  }

  const JoinedLight& light_;
  const ParameterPriors& priors_;
  double level_error_db_;
  Numbers x_;
};

}  // namespace

LeastSquaresProblem problem_of(PlanLikelihood& likelihood, std::vector<bool> is_free) {
  return {[&likelihood](const Numbers& x, const std::function<bool(double)>& take) {
            likelihood.visit_deviations(x, take);
          },
          likelihood.priors(), std::move(is_free)};
}

Numbers best_of_each_level(const LeastSquaresProblem& problem, Numbers x, std::size_t first) {
  for (std::size_t place = first; place < x.size(); ++place) {
    if (!problem.is_free[place]) continue;
    const std::vector<double> errors_db = steps_between(-1.5, 1.5, 13);
    GridPoint best = best_of_grid(problem, x, {{place, errors_db}}, 1).front();
    if (best.cost < cost_of(problem, x)) x = std::move(best.x);
  }
  return x;
}

Numbers first_numbers(const JoinedLight& light, const ParameterPriors& priors,
                      double level_error_db) {
  return FirstSearch(light, priors, level_error_db)();
}

}  // namespace sim
