#include "sim/result/curve_fit.hpp"

#define ARMA_WARN_LEVEL 0  // a singular fit is an outcome here, not news for stderr
#include <algorithm>
#include <armadillo>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "sim/counting/statistics.hpp"
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
Observations observations_of(const ExperimentResult& result) {
  Observations all;
  for (const PointResult& p : result.points) {
    if (!measured(p)) continue;
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

Crossing nothing_counted(const ExperimentResult& result) {
  if (result.points.empty()) return {};
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return {Kind::unfinished, unknown, unknown, unknown};
}

/// Whether points that were never reached lie beyond those that were: a sweep that is not done.
bool goes_on(const ExperimentResult& result, const Crossing& counted) {
  return std::ranges::any_of(result.points, [&](const PointResult& p) {
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

struct Fit {
  arma::vec coefficients;  // logit(loss) = c0 + c1 x
  arma::mat covariance;
  arma::vec loss;  // at the points
};

// Iteratively reweighted least squares (McCullagh & Nelder 1989, section 2.5), the covariance
// widened by Pearson's dispersion where the points scatter more than binomially.
std::optional<Fit> fit_logit(const arma::mat& x, const arma::vec& frames, const arma::vec& lost) {
  Fit fit{arma::vec(2), arma::mat(2, 2), (lost + 0.5) / (frames + 1)};
  arma::vec& loss = fit.loss;
  for (int step = 0; step < 50; ++step) {
    const arma::vec weights = frames % loss % (1 - loss);
    const arma::vec response = arma::log(loss / (1 - loss)) + (lost - frames % loss) / weights;
    const arma::mat information = x.t() * arma::diagmat(weights) * x;
    if (!arma::inv_sympd(fit.covariance, information)) return std::nullopt;
    const arma::vec next = fit.covariance * (x.t() * (weights % response));
    if (!next.is_finite()) return std::nullopt;
    const double change = step == 0 ? 1 : arma::norm(next - fit.coefficients) / arma::norm(next);
    fit.coefficients = next;
    loss = arma::clamp(1 / (1 + arma::exp(-x * next)), 1e-12, 1 - 1e-12);
    if (change > 1e-9) continue;
    const arma::vec misfit = arma::square(lost - frames % loss) / (frames % loss % (1 - loss));
    const double freedom = std::max(1.0, static_cast<double>(lost.n_elem) - 2);
    fit.covariance *= std::max(1.0, arma::accu(misfit) / freedom);
    return fit;
  }
  return std::nullopt;
}

std::optional<Fit> fit_logit(const Observations& all, bool logarithmic) {
  arma::mat x(all.size(), 2, arma::fill::ones);
  arma::vec frames(all.size()), lost(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    x(i, 1) = logarithmic ? std::log(all[i].x) : all[i].x;
    frames(i) = all[i].count.frames;
    lost(i) = all[i].count.lost;
  }
  return fit_logit(x, frames, lost);
}

/// By the deviance (McCullagh & Nelder 1989, section 4.4.3). Points at which the fit expects no
/// frame either lost or received lend it no freedom.
bool fits(const Fit& fit, const Observations& all) {
  double freedom = -2, deviance = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const LossCount& count = all[i].count;
    const double expected = count.frames * fit.loss(i);
    freedom += std::min(expected, count.frames - expected) > 0.5;
    deviance += 2 * (log_likelihood(count, count.ratio()) - log_likelihood(count, fit.loss(i)));
  }
  const boost::math::chi_squared by_chance(std::max(1.0, freedom));
  return cdf(complement(by_chance, std::max(0.0, deviance))) >= least_fit;
}

/// Whether so many frames are shortly before the crossing, where the fit expects a tenth of the
/// level or more, that they would rule the level out if none of them were lost: with fewer its
/// place would be guessed from far greater losses.
bool looked_for(const Fit& fit, const Observations& all, double level, double ci_level) {
  double frames = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (level / 10 <= fit.loss(i) && fit.loss(i) < level) frames += all[i].count.frames;
  return frames >= std::log((1 - ci_level) / 2) / std::log1p(-level);
}

// The crossing on the fit's own axis, with its interval by the delta method.
Crossing crossing_of(const Fit& fit, double level, double ci_level) {
  const double slope = fit.coefficients(1);
  const double at = (std::log(level / (1 - level)) - fit.coefficients(0)) / slope;
  const double z = std::sqrt(2.0) * boost::math::erf_inv(ci_level);
  if (std::abs(slope) < z * std::sqrt(fit.covariance(1, 1))) return {};
  const arma::vec gradient{-1 / slope, -at / slope};
  const double margin = z * std::sqrt(arma::as_scalar(gradient.t() * fit.covariance * gradient));
  return {Kind::fitted, at, at - margin, at + margin};
}

/// Unclear where no fit can be trusted.
Crossing fitted_crossing(const Observations& all, double level, double ci_level) {
  const bool logarithmic = std::ranges::all_of(all, [](const auto& o) { return o.x > 0; });
  const std::optional<Fit> fit = fit_logit(all, logarithmic);
  if (!fit || !fits(*fit, all) || !looked_for(*fit, all, level, ci_level)) return {};
  Crossing c = crossing_of(*fit, level, ci_level);
  if (logarithmic) c = {c.kind, std::exp(c.at), std::exp(c.low), std::exp(c.high)};
  const auto [first, last] = std::minmax(all.front().x, all.back().x);
  return first <= c.at && c.at <= last ? c : Crossing{};
}

}  // namespace

Crossing frame_loss_crossing(const ExperimentResult& result, double level) {
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
  if (none_is) return below_throughout(all, result.ci_level);
  if (all_are) return above_throughout(all, result.ci_level);

  const bool sure_of_it = surely_crossed(all, level);
  if (separated(all)) return sure_of_it ? jump(all, level, result.ci_level) : Crossing{};
  const Crossing known = sure_of_it ? bracket(all, level, result.ci_level) : Crossing{};
  const Crossing fitted = fitted_crossing(all, level, result.ci_level);
  return fitted.kind == Kind::fitted ? fitted : known;
}

}  // namespace sim
