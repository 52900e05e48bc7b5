#include "sim/fit/rule_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "sim/fit/global_search.hpp"
#include "sim/fit/grid_search.hpp"
#include "sim/fit/least_squares.hpp"

namespace sim {
namespace {

using enum RuleParameter;

/// Short bursts that the gain has nothing to do with: seldom enough, and dark before them.
bool is_short_at_rest(const Plan& plan, std::size_t s) {
  constexpr double longest_cycles = 40, least_dark_ms = 40;
  const PlanStep& step = plan.steps[s];
  const double dark_ms = s == 0 ? HUGE_VAL : step.start_ms - end_ms(plan.steps[s - 1]);
  return static_cast<double>(step.cycles_on) <= longest_cycles && dark_ms >= least_dark_ms &&
         !is_train(step);
}

/// What threshold, tune, attack and range show in, and the gain's duty hardly.
std::vector<std::size_t> bursts_and_carriers_of(const Plan& plan) {
  std::vector<std::size_t> steps = all_steps_of(plan);
  std::erase_if(steps, [&](std::size_t s) {
    return !is_short_at_rest(plan, s) && !is_long_carrier(plan.steps[s]);
  });
  return steps;
}

/// What they tell.
constexpr std::array first_numbers{
    centre, q, threshold, integrator, comparator_hold, attack, duty, margin, range, start, clock};

std::vector<bool> only_first_numbers(std::size_t all) {
  std::vector<bool> is_free(all, false);
  for (const RuleParameter one : first_numbers) is_free[place_of(one)] = true;
  return is_free;
}

LeastSquaresProblem problem_of(PlanLikelihood& likelihood, std::vector<bool> is_free) {
  return {[&likelihood](const Numbers& x) { return likelihood.deviations(x); }, likelihood.priors(),
          std::move(is_free)};
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

class RuleSearch {
 public:
  RuleSearch(const Plan& plan, const std::vector<BurstOutput>& recorded,
             const ParameterPriors& priors, double level_error_db)
      : plan_(plan),
        recorded_(recorded),
        priors_(priors),
        level_error_db_(level_error_db),
        all_(plan, recorded, all_steps_of(plan), priors, level_error_db),
        x_(all_.start()) {}

  RuleFit operator()() {
    bursts_and_carriers();
    all_steps();
    const LeastSquaresProblem whole = problem_of(all_, std::vector<bool>(all_.parameters(), true));
    const Numbers mirrored = try_mirrored_centre(whole);
    RuleFit fit{x_, covariance_at(whole, x_), x_, x_};
    for (const GridAxis& way : ways_of_jumps()) widen(fit, whole, way);
    if (cost_of(whole, mirrored) < cost_of(whole, x_) + told_cost) {
      const auto [low, high] = std::minmax(mirrored[place_of(centre)], x_[place_of(centre)]);
      fit.low[place_of(centre)] = std::min(fit.low[place_of(centre)], low);
      fit.high[place_of(centre)] = std::max(fit.high[place_of(centre)], high);
    }
    return fit;
  }

 private:
  static constexpr double told_cost = 3.84;  // chi squared of one number, 95 %

  /// Levels that are wrong may let the centre seem on the other side of the carrier. Takes the
  /// better side, and returns the best numbers of the other one.
  Numbers try_mirrored_centre(const LeastSquaresProblem& problem) {
    Numbers other = x_;
    other[place_of(centre)] = 2 * priors_[place_of(centre)].middle - x_[place_of(centre)];
    other = least_squares(problem, other, 5).x;
    if (cost_of(problem, other) < cost_of(problem, x_)) std::swap(other, x_);
    return other;
  }

  void bursts_and_carriers() {
    const std::vector<std::size_t> steps = bursts_and_carriers_of(plan_);
    if (steps.empty()) return;
    PlanLikelihood likelihood(plan_, recorded_, steps, priors_, level_error_db_);
    const LeastSquaresProblem problem =
        problem_of(likelihood, only_first_numbers(likelihood.parameters()));
    likelihood.take_wide_deviations();
    auto points = best_of_grid(problem, likelihood.start(),
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
    for (const RuleParameter one : first_numbers) x_[place_of(one)] = best[place_of(one)];
  }

  void all_steps() {
    std::vector<bool> constants(all_.parameters(), false);
    std::fill(constants.begin(), constants.begin() + n_rule_parameters, true);
    const LeastSquaresProblem few = problem_of(all_, constants);
    const LeastSquaresProblem whole = problem_of(all_, std::vector<bool>(all_.parameters(), true));
    const Numbers begin = x_;
    search(few, whole, 1);
    if (!is_poor()) return;
    const Numbers first = std::exchange(x_, begin);
    search(few, whole, 2);
    all_.take_wide_deviations();
    if (cost_of(whole, first) < cost_of(whole, x_)) x_ = first;
    all_.take_deviations_at(x_);
  }

  /// From wherever it is; another seed takes another way.
  void search(const LeastSquaresProblem& few, const LeastSquaresProblem& whole,
              unsigned long seed) {
    all_.take_wide_deviations();
    x_ = global_search(few, x_, anywhere(), evaluations(3.5e7, 1500, 4000), seed);
    x_ = best_of_holds(few);
    for (int round = 0; round < 2; ++round) {
      all_.take_deviations_at(x_);
      x_ = global_search(whole, x_, nearby(), evaluations(8e6, 400, 1000), seed);
      scan_jumps(whole);
      try_without_hold(whole);
      x_ = least_squares(whole, x_, 6).x;
    }
  }

  /// Whether more is far off than a few chaotic trains.
  bool is_poor() const {
    constexpr double far = 4;
    constexpr std::ptrdiff_t one_of = 25;
    const Numbers deviations = all_.deviations(x_);
    const auto all = std::ranges::count_if(deviations, [](double d) { return d != 0; });
    const auto off = std::ranges::count_if(deviations, [](double d) { return std::abs(d) > far; });
    return one_of * off > all;
  }

  /// Most parts have no hold. A short one is taken for more free cycles and another margin, which
  /// have to move together.
  void try_without_hold(const LeastSquaresProblem& problem) {
    constexpr double short_ms = 3;
    const double hold = x_[place_of(dark_hold)];
    if (hold <= 0 || hold > short_ms) return;
    Numbers without = x_;
    hold_for_free_cycles({0}).move(without, 0);
    const LeastSquaresFit fit = least_squares(problem, without, 4);
    if (fit.cost < cost_of(problem, x_)) x_ = fit.x;
  }

  /// Dark without recovery, and free cycles: a long train tells only the sum of both.
  GridAxis hold_for_free_cycles(std::vector<double> holds) const {
    const double share = std::min(value_of(duty, x_[place_of(duty)]), 0.9);
    const double cycles_per_ms = 1e-3 * value_of(centre, x_[place_of(centre)]);
    return {dark_hold, std::move(holds), free_cycles, cycles_per_ms * share / (1 - share)};
  }

  /// What long trains tell of duty and hold is nearly the same for another pair of them, so other
  /// holds are tried, each with its best duty.
  Numbers best_of_holds(const LeastSquaresProblem& problem) {
    constexpr std::size_t tried = 3;
    const std::vector<double> duties = steps_between(std::log(0.07), std::log(0.6), 15);
    std::vector<GridPoint> points;
    for (const double hold : {0., 4., 8., 12., 16., 20., 24., 28.}) {
      Numbers x = x_;
      x[place_of(dark_hold)] = hold;
      points.push_back(best_of_grid(problem, x, {{duty, duties}}, 1).front());
    }
    std::ranges::sort(points, {}, &GridPoint::cost);
    points.resize(tried);
    points.push_back({0, x_});
    for (GridPoint& point : points) {
      all_.take_deviations_at(point.x);
      point.x = least_squares(problem, point.x, 4).x;
      all_.take_wide_deviations();
      point.cost = cost_of(problem, point.x);
    }
    return std::ranges::min(points, {}, &GridPoint::cost).x;
  }

  /// As many as play so many bursts: a fit is to take no more than 10 s.
  int evaluations(double bursts, double least, double most) const {
    const double a_plan = static_cast<double>(first_bursts(plan_).back());
    return static_cast<int>(std::clamp(bursts / a_plan, least, most));
  }

  SearchedNumber near(RuleParameter number, double reach) const {
    const double x = x_[place_of(number)];
    return {place_of(number), x - reach, x + reach};
  }

  /// What bursts at rest and carriers do not tell may lie anywhere.
  std::vector<SearchedNumber> anywhere() const {
    return {{place_of(duty), std::log(0.06), std::log(0.6)},
            {place_of(dark_hold), -1, 30},
            {place_of(long_burst), std::log(30), std::log(160)},
            {place_of(margin), -0.3, 8},
            {place_of(free_cycles), -1, 36},
            {place_of(min_gap), std::log(6), std::log(45)},
            near(attack, 0.3),
            near(threshold, 3)};
  }

  std::vector<SearchedNumber> nearby() const {
    return {near(duty, 0.06),     near(dark_hold, 1), near(long_burst, 0.03), near(margin, 0.5),
            near(free_cycles, 4), near(min_gap, 0.2), near(attack, 0.04),     near(threshold, 0.7)};
  }

  /// Numbers with which the output jumps: whole trains are held or not.
  std::vector<GridAxis> ways_of_jumps() const {
    const double length = x_[place_of(long_burst)], hold = x_[place_of(dark_hold)];
    std::vector<double> lengths = steps_between(std::log(25), std::log(200), 41);
    std::ranges::copy(steps_between(length - 0.06, length + 0.06, 21), std::back_inserter(lengths));
    std::vector<double> holds = steps_between(0, 30, 16);
    std::ranges::copy(steps_between(hold - 2, hold + 2, 17), std::back_inserter(holds));
    std::ranges::sort(lengths);
    std::ranges::sort(holds);
    const GridAxis hold_way = hold_for_free_cycles(holds);
    return {hold_way,
            {free_cycles, steps_between(0, 40, 41), dark_hold, 1 / hold_way.slope},
            {long_burst, lengths},
            {min_gap, steps_between(std::log(5), std::log(50), 31)},
            {free_cycles, steps_between(0, 40, 27)},
            {dark_hold, holds},
            {margin, steps_between(0, 10, 31)},
            {range, steps_between(30, 140, 37)}};
  }

  /// A difference does not see what lies behind a jump, so each is tried all along its way.
  void scan_jumps(const LeastSquaresProblem& problem) {
    for (const GridAxis& way : ways_of_jumps()) {
      const GridPoint best = best_of_grid(problem, x_, {way}, 1).front();
      if (best.cost < cost_of(problem, x_)) x_ = best.x;
    }
  }

  /// As far as the first values on both sides that are told from the best.
  void widen(RuleFit& fit, const LeastSquaresProblem& problem, const GridAxis& way) const {
    const std::size_t place = place_of(way.number);
    const double most = cost_of(problem, x_) + told_cost;
    const auto is_told = [&](double value) {
      Numbers at = x_;
      way.move(at, value);
      return cost_of(problem, at) > most;
    };
    const auto above = std::ranges::upper_bound(way.values, x_[place]);
    const auto up = std::find_if(above, way.values.end(), is_told);
    const double high = up == way.values.end() ? way.values.back() : *up;
    fit.high[place] = std::max(fit.high[place], high);
    const auto down = std::find_if(std::reverse_iterator(above), way.values.rend(), is_told);
    const double low = down == way.values.rend() ? way.values.front() : *down;
    fit.low[place] = std::min(fit.low[place], low);
  }

  const Plan& plan_;
  const std::vector<BurstOutput>& recorded_;
  const ParameterPriors& priors_;
  double level_error_db_;
  PlanLikelihood all_;
  Numbers x_;
};

}  // namespace

RuleFit search_rule(const Plan& plan, const std::vector<BurstOutput>& recorded,
                    const ParameterPriors& priors, double level_error_db) {
  return RuleSearch(plan, recorded, priors, level_error_db)();
}

}  // namespace sim
