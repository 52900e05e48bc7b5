#include "sim/result/bending_curve.hpp"

#define ARMA_WARN_LEVEL 0  // a singular fit is an outcome here, not news for stderr
#include <algorithm>
#include <armadillo>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <limits>
#include <tuple>

#include "sim/counting/quantiles.hpp"

namespace sim {
namespace {

/// How much a curve may bend: while logit(loss) rises by one, the deviation of its slope's change
/// over the mean slope; assumed. logit of a Gaussian's tail bends by 0.18 at 1 %, of frames of bits
/// in Gaussian noise by 0.12, of TSSP4056 at the end of its reach by 0.13; where a loss leaves its
/// floor it bends by about one. Curves that bend less than the first get wider intervals than they
/// need, of the others the counts tell. Where they tell of the last, nothing is known of the curve
/// between points.
constexpr std::array bends{0.2, 0.8, 3.2};

/// Deviation of the mean slope, in logits over the whole sweep: as good as free.
constexpr double steepest = 1000;

/// The log-likelihood's part that depends on the logits.
double likelihood_of(const arma::vec& logits, const arma::vec& frames, const arma::vec& lost) {
  const arma::vec received = arma::clamp(logits, 0, arma::datum::inf) +
                             arma::log1p(arma::exp(-arma::abs(logits)));  // -log(1 - loss)
  return arma::dot(lost, logits) - arma::dot(frames, received);
}

/// Curves that pass the level at one place.
class CurvesThrough {
 public:
  CurvesThrough(const arma::vec& x, const LossCounts& counts, double level)
      : x_(x),
        frames_(x.n_elem),
        lost_(x.n_elem),
        level_(std::log(level / (1 - level))),
        line_(std::pow(steepest / (x.max() - x.min()), 2)) {
    for (std::size_t i = 0; i < counts.size(); ++i) {
      frames_(i) = counts[i].frames;
      lost_(i) = counts[i].lost;
    }
  }

  /// Straight lines alone without it.
  void set_slope(double mean) {
    wiener_.clear();
    for (const double bend : bends)
      wiener_.push_back(std::pow(bend, 2) * std::pow(std::abs(mean), 3));
  }

  /// -2 log(likelihood) of all that pass the level at this place, of the bend of which it is most.
  /// Not a number where there is none.
  double misfit(double place) {
    from_place_ = x_ - place;
    std::optional<State> best;
    for (std::size_t i = 0; i < wiener_.size(); ++i) {
      const std::optional<State> next = likeliest_of(covariance_here(wiener_[i]));
      if (!next || (best && !(next->evidence > best->evidence))) break;
      best = next;
      best->is_wild = i + 1 == bends.size();
    }
    if (!best) return std::numeric_limits<double>::quiet_NaN();
    likeliest_ = *best;
    return -2 * best->evidence;
  }

  /// Of the curve that was found last: whether it bends more than can be told, its slope where it
  /// passes the level, the loss at the points.
  bool is_wild() const { return likeliest_.is_wild; }
  double slope() const { return line_ * arma::dot(likeliest_.dual, from_place_); }
  std::vector<double> loss() const {
    return arma::conv_to<std::vector<double>>::from(loss_at(likeliest_.rise));
  }

 private:
  struct State {
    arma::vec dual;         // of it the covariance makes the rise
    arma::vec rise;         // logits above the level
    double likelihood = 0;  // with that of the curve itself
    double evidence = 0;    // logarithm of the likelihood of all curves of its kind together
    bool is_wild = false;   // its kind bends most
  };

  /// Laplace's method for Gaussian processes (Rasmussen & Williams 2006, section 3.4), its steps
  /// halved where they would lead downhill.
  std::optional<State> likeliest_of(const arma::mat& covariance) const {
    State now = beginning(covariance);
    for (int step = 0; step < 100; ++step) {
      const std::optional<arma::vec> aim = newton(now.rise, covariance);
      if (!aim) return std::nullopt;
      const double before = now.likelihood;
      now = best_on_the_way(now, *aim, covariance);
      if (now.likelihood - before < 1e-7) break;
    }
    double log_determinant = 0;
    if (!arma::log_det_sympd(log_determinant, system_of(weight_at(now.rise), covariance)))
      return std::nullopt;
    now.evidence = now.likelihood - log_determinant / 2;  // their equation 3.32
    return now;
  }

  State state(const arma::vec& dual, const arma::mat& covariance) const {
    State s{.dual = dual, .rise = covariance * dual};
    s.likelihood = likelihood_of(level_ + s.rise, frames_, lost_) - arma::dot(dual, s.rise) / 2;
    return s;
  }

  /// The curve that was found last, where that is better than none.
  State beginning(const arma::mat& covariance) const {
    State none = state(arma::vec(x_.n_elem, arma::fill::zeros), covariance);
    if (likeliest_.dual.is_empty()) return none;
    State last = state(likeliest_.dual, covariance);
    return last.likelihood > none.likelihood ? last : none;
  }

  arma::vec loss_at(const arma::vec& rise) const { return 1 / (1 + arma::exp(-level_ - rise)); }

  /// From the place on the process runs to either side on its own (Rasmussen & Williams 2006,
  /// equation 6.28).
  arma::mat covariance_here(double wiener) const {
    const arma::vec& u = from_place_;
    arma::mat covariance = line_ * u * u.t();
    for (std::size_t i = 0; i < u.n_elem; ++i)
      for (std::size_t j = 0; j < u.n_elem; ++j) {
        if (u(i) * u(j) <= 0) continue;
        const auto [near, far] = std::minmax({std::abs(u(i)), std::abs(u(j))});
        covariance(i, j) += wiener * near * near * (3 * far - near) / 6;
      }
    return covariance;
  }

  arma::vec weight_at(const arma::vec& rise) const {
    const arma::vec loss = loss_at(rise);
    return frames_ % loss % (1 - loss);
  }
  static arma::mat system_of(const arma::vec& weight, const arma::mat& covariance) {
    const arma::vec root = arma::sqrt(weight);
    arma::mat system = covariance % (root * root.t());
    system.diag() += 1;
    return system;
  }

  std::optional<arma::vec> newton(const arma::vec& rise, const arma::mat& covariance) const {
    const arma::vec weight = weight_at(rise), root = arma::sqrt(weight);
    const arma::vec pull = weight % rise + lost_ - frames_ % loss_at(rise);
    const arma::vec right = root % (covariance * pull);
    arma::vec solved;
    if (!arma::solve(solved, system_of(weight, covariance), right, arma::solve_opts::likely_sympd))
      return std::nullopt;
    return pull - root % solved;
  }

  State best_on_the_way(const State& from, const arma::vec& aim,
                        const arma::mat& covariance) const {
    for (double share = 1; share > 1e-5; share /= 2) {
      State next = state(from.dual + share * (aim - from.dual), covariance);
      if (next.likelihood >= from.likelihood) return next;
    }
    return from;
  }

  arma::vec x_, frames_, lost_;
  double level_;                   // as a logit
  double line_;                    // variance of the slope
  std::vector<double> wiener_{0};  // variance that it may gain along x
  arma::vec from_place_;
  State likeliest_;
};

/// Among the points.
double likeliest_place(CurvesThrough& curves, const std::vector<double>& x) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double misfit = curves.misfit(x[i]);
    if (!(misfit < least)) continue;
    least = misfit;
    best = i;
  }
  const auto [low, high] =
      std::minmax(x[std::max<std::size_t>(best, 1) - 1], x[std::min(best + 1, x.size() - 1)]);
  constexpr int bits = 24;
  return boost::math::tools::brent_find_minima([&](double place) { return curves.misfit(place); },
                                               low, high, bits)
      .first;
}

/// The first place on the way from `at` from which on the misfit is more than allowed; nothing if
/// it is not up to the limit. Far beyond the points a curve could come back to the level.
std::optional<double> end_of_interval(CurvesThrough& curves, double allowed, double at,
                                      double limit) {
  const auto is_outside = [&](double share) {
    return curves.misfit(at + share * (limit - at)) > allowed;
  };
  constexpr double first_step = 1. / 1024;
  double inside = 0, outside = first_step;  // shares of the way
  for (; !is_outside(outside); outside *= 2) {
    if (outside >= 1) return std::nullopt;
    inside = outside;
  }
  for (int halvings = 0; halvings < 12; ++halvings) {
    const double middle = (inside + outside) / 2;
    (is_outside(middle) ? outside : inside) = middle;
  }
  return at + outside * (limit - at);
}

}  // namespace

std::optional<CurveCrossing> curve_crossing(const std::vector<double>& x, const LossCounts& counts,
                                            double level, double ci_level) {
  CurvesThrough curves(x, counts, level);
  if (x.front() == x.back() || std::isnan(curves.misfit(likeliest_place(curves, x))))
    return std::nullopt;
  curves.set_slope(curves.slope());
  const double at = likeliest_place(curves, x), span = x.back() - x.front();
  const double share = (at - x.front()) / span;  // of the way
  constexpr double edge = 1e-4;
  if (!(share > edge && share < 1 - edge)) return std::nullopt;

  const double quantile = std::pow(normal_quantile(ci_level), 2);  // of chi-square
  const double allowed = curves.misfit(at) + quantile;
  if (curves.is_wild()) return std::nullopt;
  CurveCrossing crossing{at, 0, 0, curves.loss()};
  const auto before = end_of_interval(curves, allowed, at, x.front() - span / 4);
  const auto behind = end_of_interval(curves, allowed, at, x.back() + span / 4);
  if (!before || !behind) return std::nullopt;
  std::tie(crossing.low, crossing.high) = std::minmax(*before, *behind);
  return crossing;
}

}  // namespace sim
