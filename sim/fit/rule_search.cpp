#include "sim/fit/rule_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "sim/fit/first_search.hpp"
#include "sim/fit/global_search.hpp"
#include "sim/fit/grid_search.hpp"
#include "sim/fit/least_squares.hpp"
#include "sim/fit/profile_search.hpp"

namespace sim {
namespace {

using enum RuleParameter;

class RuleSearch {
 public:
  RuleSearch(const JoinedLight& light, const ParameterPriors& priors, double level_error_db)
      : priors_(priors),
        searched_(cut_trains(light, first_of_train), all_steps_of(light.plan), priors,
                  level_error_db),
        all_(light, all_steps_of(light.plan), priors, level_error_db),
        scale_error_(scale_error(light, level_error_db)),
        x_(first_numbers(light, priors, level_error_db)) {}

  RuleFit operator()() {
    search_first_bursts();
    all_.take_deviations_at(x_);
    const LeastSquaresProblem whole = problem_of(all_, std::vector<bool>(all_.parameters(), true));
    scan_levels(whole);
    x_ = profile_search(whole, x_, constants(), [&] { return has_time_left(); });
    const Numbers mirrored = try_mirrored_centre(whole);
    RuleFit fit{x_, covariance_at(whole, x_), x_, x_, scale_error_};
    for (const GridAxis& way : ways_of_jumps()) widen(fit, whole, way);
    if (fit.high[place_of(range)] < furthest_range_db && is_as_good_without_limit(whole))
      fit.high[place_of(range)] = HUGE_VAL;
    if (cost_of(whole, mirrored) < cost_of(whole, x_) + told_cost) {
      const auto [low, high] = std::minmax(mirrored[place_of(centre)], x_[place_of(centre)]);
      fit.low[place_of(centre)] = std::min(fit.low[place_of(centre)], low);
      fit.high[place_of(centre)] = std::max(fit.high[place_of(centre)], high);
    }
    return fit;
  }

 private:
  static constexpr double told_cost = 3.84;  // chi squared of one number, 95 %
  static constexpr double furthest_range_db = 140;
  static constexpr std::uint64_t first_of_train = 300;  // bursts, which tell most of it

  /// A fit is to take no more than 10 s, and a million bursts take 0.1 s.
  bool has_time_left(std::uint64_t for_bursts = 0) const {
    constexpr std::uint64_t bursts_of_a_fit = 60'000'000;
    return searched_.bursts_played() + all_.bursts_played() + for_bursts < bursts_of_a_fit;
  }

  /// Levels that are wrong may let the centre seem on the other side of the carrier. Takes the
  /// better side, and returns the best numbers of the other one.
  Numbers try_mirrored_centre(const LeastSquaresProblem& problem) {
    Numbers other = x_;
    other[place_of(centre)] = 2 * priors_[place_of(centre)].middle - x_[place_of(centre)];
    other = least_squares(problem, other, 5).x;
    if (cost_of(problem, other) < cost_of(problem, x_)) std::swap(other, x_);
    return other;
  }

  /// Whether other numbers explain as well that the gain falls without end: a limit just beyond the
  /// strongest light does what a level does that is wrong by 10 %.
  bool is_as_good_without_limit(const LeastSquaresProblem& problem) const {
    constexpr double no_limit_db = 190, as_good = 8 * told_cost;  // rounding is alike in many steps
    LeastSquaresProblem others = problem;
    others.is_free[place_of(range)] = false;
    others.priors[place_of(range)].deviation = HUGE_VAL;
    Numbers without = x_;
    without[place_of(range)] = no_limit_db;
    without = least_squares(others, without, 4).x;
    return cost_of(others, without) < cost_of(others, x_) + as_good;
  }

  void search_first_bursts() {
    const LeastSquaresProblem few = problem_of(searched_, constants());
    const LeastSquaresProblem whole =
        problem_of(searched_, std::vector<bool>(searched_.parameters(), true));
    const Numbers begin = x_;
    search(few, whole, 1);
    const std::uint64_t taken = searched_.bursts_played();
    if (!is_poor() || !has_time_left(taken)) return;
    const Numbers first = std::exchange(x_, begin);
    search(few, whole, 2);
    searched_.take_wide_deviations();
    if (cost_of(whole, first) < cost_of(whole, x_)) x_ = first;
  }

  /// From wherever it is; another seed takes another way.
  void search(const LeastSquaresProblem& few, const LeastSquaresProblem& whole,
              unsigned long seed) {
    searched_.take_wide_deviations();
    x_ = global_search(few, x_, anywhere(), evaluations(3.5e7, 1500, 4000), seed);
    x_ = best_of_holds(few);
    for (int round = 0; round < 2; ++round) {
      searched_.take_deviations_at(x_);
      scan_jumps(whole);
      try_without_hold(whole);
      x_ = least_squares(whole, x_, 6).x;
    }
  }

  void scan_levels(const LeastSquaresProblem& problem) {
    x_ = best_of_each_level(problem, x_, all_.before_levels());
    x_ = least_squares(problem, x_, 6).x;
  }

  /// Those of the rule and of captures: all but the levels.
  std::vector<bool> constants() const {
    std::vector<bool> numbers(all_.parameters(), false);
    std::fill_n(numbers.begin(), all_.before_levels(), true);
    return numbers;
  }

  /// Whether more is far off than a few chaotic trains.
  bool is_poor() const {
    constexpr double far = 4;
    constexpr std::ptrdiff_t one_of = 25;
    const Numbers deviations = searched_.deviations(x_);
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
    return {place_of(dark_hold), std::move(holds), place_of(free_cycles),
            cycles_per_ms * share / (1 - share)};
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
      points.push_back(best_of_grid(problem, x, {{place_of(duty), duties}}, 1).front());
    }
    std::ranges::sort(points, {}, &GridPoint::cost);
    points.resize(tried);
    points.push_back({0, x_});
    for (GridPoint& point : points) {
      searched_.take_deviations_at(point.x);
      point.x = least_squares(problem, point.x, 4).x;
      searched_.take_wide_deviations();
      point.cost = cost_of(problem, point.x);
    }
    return std::ranges::min(points, {}, &GridPoint::cost).x;
  }

  /// As many as play so many bursts of the plan.
  int evaluations(double bursts, double least, double most) const {
    const double a_plan = static_cast<double>(first_bursts(searched_.plan()).back());
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

  /// Numbers with which the output jumps: whole trains are held or not.
  std::vector<GridAxis> ways_of_jumps() const {
    const double length = x_[place_of(long_burst)], hold = x_[place_of(dark_hold)];
    std::vector<double> lengths = steps_between(std::log(25), std::log(200), 41);
    std::ranges::copy(steps_between(length - 0.06, length + 0.06, 21), std::back_inserter(lengths));
    std::vector<double> holds = steps_between(0, 30, 16);
    std::ranges::copy(steps_between(hold - 2, hold + 2, 17), std::back_inserter(holds));
    std::ranges::sort(lengths);
    std::ranges::sort(holds);
    const double fall = x_[place_of(range)];
    std::vector<double> ranges = steps_between(30, furthest_range_db, 37);
    std::ranges::copy(steps_between(fall - 4, fall + 4, 17), std::back_inserter(ranges));
    std::ranges::sort(ranges);
    const GridAxis hold_way = hold_for_free_cycles(holds);
    return {
        {place_of(integrator), steps_between(std::log(3), std::log(14), 17)},
        hold_way,
        {place_of(free_cycles), steps_between(0, 40, 41), place_of(dark_hold), 1 / hold_way.slope},
        {place_of(long_burst), lengths},
        {place_of(min_gap), steps_between(std::log(5), std::log(50), 31)},
        {place_of(free_cycles), steps_between(0, 40, 27)},
        {place_of(dark_hold), holds},
        {place_of(margin), steps_between(0, 10, 31)},
        {place_of(range), ranges}};
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
    const std::size_t place = way.place;
    const double most = cost_of(problem, x_) + told_cost;
    const auto is_told = [&](double value) {
      Numbers at = x_;
      way.move(at, value);
      return cost_of(problem, at, most) > most;
    };
    const auto above = std::ranges::upper_bound(way.values, x_[place]);
    const auto up = std::find_if(above, way.values.end(), is_told);
    const double high = up == way.values.end() ? way.values.back() : *up;
    fit.high[place] = std::max(fit.high[place], high);
    const auto down = std::find_if(std::reverse_iterator(above), way.values.rend(), is_told);
    const double low = down == way.values.rend() ? way.values.front() : *down;
    fit.low[place] = std::min(fit.low[place], low);
  }

  const ParameterPriors& priors_;
  PlanLikelihood searched_, all_;
  double scale_error_;
  Numbers x_;
};

}  // namespace

RuleFit search_rule(const JoinedLight& light, const ParameterPriors& priors,
                    double level_error_db) {
  return RuleSearch(light, priors, level_error_db)();
}

}  // namespace sim
