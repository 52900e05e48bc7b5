#include "sim/result/curve_fit.hpp"

#define ARMA_WARN_LEVEL 0  // a singular fit is an outcome here, not news for stderr
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <armadillo>
#include <boost/math/special_functions/erf.hpp>
#include <cassert>
#include <cmath>
#include <optional>

#include "sim/counting/statistics.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

using Kind = Crossing::Kind;

// Points are called different only beyond doubt, as a sweep compares many pairs of them.
constexpr double sure = 0.999;

struct Observation {
  double x, frames, lost;
  Interval loss;
  double ratio() const { return lost / frames; }
};

using Observations = std::vector<Observation>;

// In the direction in which the loss rises.
Observations observations_of(const ExperimentResult& result) {
  Observations all;
  for (const PointResult& p : result.points) {
    if (!measured(p)) continue;
    const double frames = static_cast<double>(p.tally.n_frames);
    const double lost = static_cast<double>(p.tally.n_frames_lost);
    all.push_back({p.coordinates.at(0), frames, lost, clopper_pearson(lost, frames, sure)});
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
  const auto first_loss = std::ranges::find_if(all, [](const auto& o) { return o.lost > 0; });
  return std::all_of(first_loss + 1, all.end(), [](const auto& o) { return o.lost == o.frames; });
}

// From the last point before the level to the first behind it; wider where points disagree.
Crossing bracket(Crossing::Kind kind, const Observations& all, double level, double ci_level) {
  std::size_t first_bad = 0, last_good = all.size() - 1;
  while (all[first_bad].ratio() <= level) ++first_bad;
  while (all[last_good].ratio() > level) --last_good;
  const double from = all[std::max<std::size_t>(first_bad, 1) - 1].x;
  const double to = all[std::min(last_good + 1, all.size() - 1)].x;
  const Observation& before = all[std::max<std::size_t>(first_bad, 1) - 1];
  const double bound = clopper_pearson(before.lost, before.frames, ci_level).high;
  return {kind, (from + to) / 2, std::min(from, to), std::max(from, to), bound};
}

Crossing whole_sweep(Crossing::Kind kind, const Observations& all) {
  const auto [low, high] = std::minmax(all.front().x, all.back().x);
  return {kind, (low + high) / 2, low, high};
}

Crossing below_throughout(const Observations& all, double ci_level) {
  Crossing c = whole_sweep(Crossing::Kind::all_below, all);
  for (const Observation& o : all)
    c.bound = std::max(c.bound, clopper_pearson(o.lost, o.frames, ci_level).high);
  return c;
}

Crossing above_throughout(const Observations& all, double ci_level) {
  Crossing c = whole_sweep(Crossing::Kind::all_above, all);
  c.bound = 1;
  for (const Observation& o : all)
    c.bound = std::min(c.bound, clopper_pearson(o.lost, o.frames, ci_level).low);
  return c;
}

/// ", though 3.8 % cannot be ruled out": what the frames do not tell.
std::string doubt(const Crossing& c, double level) {
  const bool doubtful = c.kind == Kind::all_above ? c.bound < level : c.bound > level;
  return doubtful ? fmt::format(", though {:.2g} % cannot be ruled out", c.bound * 100) : "";
}

struct Fit {
  arma::vec coefficients;  // logit(loss) = c0 + c1 x
  arma::mat covariance;
};

// Iteratively reweighted least squares (McCullagh & Nelder 1989, section 2.5), the covariance
// widened by Pearson's dispersion where the points scatter more than binomially.
std::optional<Fit> fit_logit(const arma::mat& x, const arma::vec& frames, const arma::vec& lost) {
  Fit fit{arma::vec(2), arma::mat(2, 2)};
  arma::vec loss = (lost + 0.5) / (frames + 1);
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
    frames(i) = all[i].frames;
    lost(i) = all[i].lost;
  }
  return fit_logit(x, frames, lost);
}

/// Below it nothing more than an estimate is asked for: few sweeps have the frames for more.
bool surely_crossed(const Observations& all, double level) {
  return std::ranges::any_of(all, [=](const auto& o) { return o.ratio() <= level; }) &&
         std::ranges::any_of(all, [=](const auto& o) { return o.loss.low > level; });
}

bool contradicted(const Observations& all, double at, double level) {
  const bool upward = all.front().x < all.back().x;
  return std::ranges::any_of(all, [=](const Observation& o) {
    const bool before = (o.x < at) == upward;
    return before ? o.loss.low > level : o.loss.high < level;
  });
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

std::string span_text(const Crossing& c) {
  return c.low == c.high ? fmt::format("{:g}", c.low) : fmt::format("{:g} .. {:g}", c.low, c.high);
}

std::string fitted_text(const Crossing& c) {
  const double margin = std::max((c.high - c.low) / 2, 1e-12);
  const int places = std::max(0, -static_cast<int>(std::floor(std::log10(margin))));
  return fmt::format("{:.{}f} [{:.{}f}, {:.{}f}]", c.at, places, c.low, places, c.high, places);
}

}  // namespace

Crossing frame_loss_crossing(const ExperimentResult& result, double level) {
  assert(result.axes.size() == 1 && level > 0 && level < 1);
  const Observations all = observations_of(result);
  const auto is_bad = [=](const Observation& o) { return o.ratio() > level; };
  if (!rises_throughout(all)) return {Kind::not_monotone};
  if (all.empty()) return {};
  if (std::ranges::none_of(all, is_bad)) return below_throughout(all, result.ci_level);
  if (std::ranges::all_of(all, is_bad)) return above_throughout(all, result.ci_level);
  if (separated(all) && surely_crossed(all, level))
    return bracket(Kind::jump, all, level, result.ci_level);

  const Crossing unfitted = surely_crossed(all, level)
                                ? bracket(Kind::unfitted, all, level, result.ci_level)
                                : Crossing{};
  if (separated(all)) return unfitted;
  const bool logarithmic = std::ranges::all_of(all, [](const auto& o) { return o.x > 0; });
  const std::optional<Fit> fit = fit_logit(all, logarithmic);
  if (!fit) return unfitted;
  Crossing c = crossing_of(*fit, level, result.ci_level);
  if (logarithmic) c = {c.kind, std::exp(c.at), std::exp(c.low), std::exp(c.high)};
  const auto [first, last] = std::minmax(all.front().x, all.back().x);
  const bool inside = first <= c.at && c.at <= last;
  const bool trusted = c.kind == Kind::fitted && inside && !contradicted(all, c.at, level);
  return trusted ? c : unfitted;
}

std::string quantity(const Axis& axis, const std::string& value) {
  return axis.key + " = " + with_unit(value, axis.unit);
}

std::string place_text(const std::vector<Axis>& axes, const std::vector<double>& coordinates) {
  std::vector<std::string> places;
  for (std::size_t i = 0; i < axes.size(); ++i)
    places.push_back(quantity(axes[i], coordinate_text(axes[i], coordinates[i])));
  return fmt::format("{}", fmt::join(places, ", "));
}

std::string crossing_words(const Axis& axis, const Crossing& c, double level) {
  const std::string range = with_unit(span_text(c), axis.unit);
  const std::string gap = with_unit(fmt::format("{:g} and {:g}", c.low, c.high), axis.unit);
  const double percent = level * 100;
  switch (c.kind) {
    case Kind::fitted:
      return with_unit(fitted_text(c), axis.unit);
    case Kind::jump:
      return "between " + gap;
    case Kind::unfitted:
      return "between " + gap + " (no logit curve fits the points)";
    case Kind::all_below:
      return fmt::format("beyond the sweep: at most {:g} % lost in {}", percent, range) +
             doubt(c, level);
    case Kind::all_above:
      return fmt::format("short of the sweep: more than {:g} % lost in all of {}", percent, range) +
             doubt(c, level);
    case Kind::not_monotone:
      return "loss rises and falls: no single value, see the table";
    case Kind::unclear:
      break;
  }
  return fmt::format("unclear: too few frames to tell its side of {:g} %", percent);
}

std::string crossing_sentence(const Axis& axis, const Crossing& c, double level) {
  const std::string crosses = fmt::format("frame loss crosses {:g} % ", level * 100);
  const std::string range = quantity(axis, span_text(c));
  switch (c.kind) {
    case Kind::fitted:
      return crosses + "at " + quantity(axis, fitted_text(c));
    case Kind::jump:
      return crosses + "between " + range + " (no point lies between" +
             (doubt(c, level).empty() ? "" : doubt(c, level) + " before them") + ")";
    case Kind::unfitted:
      return crosses + "between " + range + " (no logit curve fits the points)";
    case Kind::not_monotone:
      return fmt::format("frame loss rises and falls along {}: no single crossing of {:g} %",
                         axis.key, level * 100);
    case Kind::all_below:
      return fmt::format("frame loss {} at most {:g} % over ",
                         doubt(c, level).empty() ? "stays" : "is seen to stay", level * 100) +
             range + doubt(c, level);
    case Kind::all_above:
      return fmt::format("frame loss is above {:g} % over ", level * 100) + range + doubt(c, level);
    case Kind::unclear:
      break;
  }
  return fmt::format("frame loss does not clearly cross {:g} % inside the sweep of {}", level * 100,
                     axis.key);
}

}  // namespace sim
