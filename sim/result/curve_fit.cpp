#include "sim/result/curve_fit.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/counting/statistics.hpp"
#include "sim/result/bending_curve.hpp"
#include "sim/result/isotonic.hpp"

namespace sim {
namespace {

using Kind = Crossing::Kind;

// Points are called different only beyond doubt, as a sweep compares many pairs of them.
constexpr double sure = 0.999;

// A fit that misses the points by more than chance would in one sweep of twenty is not believed.
constexpr double least_fit = 0.05;

struct Observation {
  double x = 0;
  LossCount count{};
  Interval loss{};

  double ratio() const { return count.ratio(); }
};

using Observations = std::vector<Observation>;

// In the direction in which the loss rises.
Observations observations_of(const LinkResult& result) {
  Observations all;
  for (const LinkPoint& p : result.points) {
    if (!p.reached()) continue;
    const LossCount count{static_cast<double>(p.tally.n_frames),
                          static_cast<double>(p.tally.n_frames_lost)};
    all.push_back({p.coordinates.at(0), count, clopper_pearson(count.lost, count.frames, sure)});
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  if (!all.empty() && all.front().ratio() > all.back().ratio()) std::ranges::reverse(all);
  return all;
}

bool rises_throughout(const Observations& all) {
  double floor = 0;
  for (const Observation& o : all) {
    if (o.loss.high < floor) return false;
    floor = std::max(floor, o.loss.low);
  }
  return true;
}

// Then the likelihood has no maximum: the steeper, the likelier (Albert & Anderson 1984).
bool separated(const Observations& all) {
  const auto lossless = [](const auto& o) { return o.count.lost == 0; };
  const auto first_loss = std::ranges::find_if_not(all, lossless);
  return std::all_of(first_loss + 1, all.end(), [](const auto& o) { return o.ratio() == 1; });
}

Crossing whole_sweep(Kind kind, const Observations& all) {
  const auto [low, high] = std::minmax(all.front().x, all.back().x);
  return {kind, (low + high) / 2, low, high};
}

Crossing nothing_counted(const LinkResult& result) {
  if (result.points.empty()) return {};
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return {Kind::unfinished, unknown, unknown, unknown};
}

/// Whether points that were never reached lie beyond those that were: a sweep that is not done.
bool goes_on(const LinkResult& result, const Crossing& counted) {
  return std::ranges::any_of(result.points, [&](const LinkPoint& p) {
    return p.coordinates.at(0) < counted.low || p.coordinates.at(0) > counted.high;
  });
}

Crossing below_throughout(const Observations& all, double ci_level) {
  Crossing c = whole_sweep(Kind::all_below, all);
  for (const Observation& o : all)
    c.bound = std::max(c.bound, clopper_pearson(o.count.lost, o.count.frames, ci_level).high);
  return c;
}

Crossing above_throughout(const Observations& all, double ci_level) {
  Crossing c = whole_sweep(Kind::all_above, all);
  c.bound = 1;
  for (const Observation& o : all)
    c.bound = std::min(c.bound, clopper_pearson(o.count.lost, o.count.frames, ci_level).low);
  return c;
}

/// Below it nothing more than an estimate is asked for: few sweeps have the frames for more.
bool surely_crossed(const Observations& all, double level) {
  return std::ranges::any_of(all, [=](const auto& o) { return o.ratio() <= level; }) &&
         std::ranges::any_of(all, [=](const auto& o) { return o.loss.low > level; });
}

LossCounts counts_of(const Observations& all) {
  LossCounts counts;
  for (const Observation& o : all) counts.push_back(o.count);
  return counts;
}

/// The last point before the level and the first behind it; farther apart where points disagree.
std::pair<const Observation&, const Observation&> step_of(const Observations& all, double level) {
  std::size_t first_bad = 0, last_good = all.size() - 1;
  while (all[first_bad].ratio() <= level) ++first_bad;
  while (all[last_good].ratio() > level) --last_good;
  return {all[std::max<std::size_t>(first_bad, 1) - 1],
          all[std::min(last_good + 1, all.size() - 1)]};
}

double middle_of(const std::pair<const Observation&, const Observation&>& step) {
  return (step.first.x + step.second.x) / 2;
}

Crossing jump(const Observations& all, double level, double ci_level) {
  const auto step = step_of(all, level);
  const auto& [before, behind] = step;
  const auto [low, high] = std::minmax(before.x, behind.x);
  const double bound = clopper_pearson(before.count.lost, before.count.frames, ci_level).high;
  return {Kind::jump, middle_of(step), low, high, bound, before.x};
}

/// Of a loss that was seen to pass the level for certain.
Crossing bracket(const Observations& all, double level, double ci_level) {
  const LevelCuts cuts = isotonic_cuts(counts_of(all), level, ci_level);
  const bool upward = all.front().x < all.back().x;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double before = upward ? -infinity : infinity, behind = -before;
  if (cuts.first == 0 && cuts.last == all.size()) return {};
  if (cuts.first > 0) before = all[cuts.first - 1].x;
  if (cuts.last < all.size()) behind = all[cuts.last].x;
  const auto [low, high] = std::minmax(before, behind);
  return {Kind::bracketed, middle_of(step_of(all, level)), low, high};
}

/// As many as are looked at by a curve, those about the step: of more the work grows with the cube,
/// and those far from the level say little of where it is passed.
Observations about_step(const Observations& all, double level) {
  constexpr std::ptrdiff_t most = 100;
  const std::ptrdiff_t surplus = std::max<std::ptrdiff_t>(0, std::ssize(all) - most);
  const std::ptrdiff_t step = &step_of(all, level).first - all.data();
  const auto begin = all.begin() + std::clamp<std::ptrdiff_t>(step - most / 2, 0, surplus);
  return {begin, begin + (std::ssize(all) - surplus)};
}

/// The frames of a pool, how many of them were lost, and how many a curve expects.
struct Pool {
  LossCount count{};
  double expected = 0;

  bool is_large() const {
    constexpr double enough = 5;  // for chi-square (Cochran 1954)
    return std::min(expected, count.frames - expected) >= enough;
  }
  double deviance() const {
    return 2 *
           (log_likelihood(count, count.ratio()) - log_likelihood(count, expected / count.frames));
  }
};

/// By the deviance (McCullagh & Nelder 1989, section 4.4.3) of neighbours taken together, so that
/// of each pool some frames are expected to be lost and some to be received. What is left at an end
/// is no pool.
bool fits(const std::vector<double>& loss, const Observations& all) {
  double freedom = -2, deviance = 0;
  Pool pool;
  for (std::size_t i = 0; i < all.size(); ++i) {
    pool.count.frames += all[i].count.frames;
    pool.count.lost += all[i].count.lost;
    pool.expected += all[i].count.frames * loss[i];
    if (!pool.is_large()) continue;
    ++freedom;
    deviance += pool.deviance();
    pool = {};
  }
  const boost::math::chi_squared by_chance(std::max(1.0, freedom));
  return cdf(complement(by_chance, std::max(0.0, deviance))) >= least_fit;
}

/// Whether so many frames are shortly before the crossing, where the curve expects a tenth of the
/// level or more, that they would rule the level out if none of them were lost: with fewer its
/// place would be guessed from far greater losses.
bool looked_for(const std::vector<double>& loss, const Observations& all, double level,
                double ci_level) {
  double frames = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (level / 10 <= loss[i] && loss[i] < level) frames += all[i].count.frames;
  return frames >= std::log((1 - ci_level) / 2) / std::log1p(-level);
}

/// Of fewer, nothing tells how the curve bends between them.
constexpr std::size_t enough_points = 4;

/// Unclear where no fit can be trusted.
Crossing fitted_crossing(const Observations& all, double level, double ci_level) {
  if (all.size() < enough_points) return {};
  const bool logarithmic = std::ranges::all_of(all, [](const auto& o) { return o.x > 0; });
  std::vector<double> x;
  for (const Observation& o : all) x.push_back(logarithmic ? std::log(o.x) : o.x);
  const auto fit = curve_crossing(x, counts_of(all), level, ci_level);
  if (!fit || !fits(fit->loss, all) || !looked_for(fit->loss, all, level, ci_level)) return {};
  if (!logarithmic) return {Kind::fitted, fit->at, fit->low, fit->high};
  return {Kind::fitted, std::exp(fit->at), std::exp(fit->low), std::exp(fit->high)};
}

}  // namespace

Crossing frame_loss_crossing(const LinkResult& result, double level) {
  assert(result.axes.size() == 1 && level > 0 && level < 1);
  const Observations all = observations_of(result);
  const auto is_bad = [=](const Observation& o) { return o.ratio() > level; };
  if (!rises_throughout(all)) return {Kind::not_monotone};
  if (all.empty()) return nothing_counted(result);
  const bool none_is = std::ranges::none_of(all, is_bad),
             all_are = std::ranges::all_of(all, is_bad);
  if (none_is || all_are) {
    const Crossing counted = whole_sweep(Kind::unfinished, all);
    if (goes_on(result, counted)) return counted;
  }
  if (none_is) return below_throughout(all, LinkResult::ci_level);
  if (all_are) return above_throughout(all, LinkResult::ci_level);

  const bool sure_of_it = surely_crossed(all, level);
  if (separated(all)) return sure_of_it ? jump(all, level, LinkResult::ci_level) : Crossing{};
  const Crossing known = sure_of_it ? bracket(all, level, LinkResult::ci_level) : Crossing{};
  const Crossing fitted = fitted_crossing(about_step(all, level), level, LinkResult::ci_level);
  return fitted.kind == Kind::fitted ? fitted : known;
}

}  // namespace sim
