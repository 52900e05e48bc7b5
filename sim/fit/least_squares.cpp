#include "sim/fit/least_squares.hpp"

#include <algorithm>
#include <armadillo>
#include <cmath>
#include <limits>
#include <optional>

namespace sim {
namespace {

/// Deviations beyond it count for less and less: Cauchy's loss.
constexpr double cauchy_scale = 2.5;

double loss_of(double deviation) {
  constexpr double squared = cauchy_scale * cauchy_scale;
  return squared * std::log1p(deviation * deviation / squared);
}

Numbers deviations_at(const LeastSquaresProblem& problem, const Numbers& x) {
  Numbers all;
  problem.visit_deviations(x, [&](double deviation) {
    all.push_back(deviation);
    return true;
  });
  return all;
}

double cost_of_priors(const LeastSquaresProblem& problem, const Numbers& x) {
  double sum = 0;
  for (std::size_t i = 0; i < problem.priors.size(); ++i)
    sum += std::pow((x[i] - problem.priors[i].middle) / problem.priors[i].deviation, 2);
  return sum;
}

std::vector<std::size_t> free_numbers(const LeastSquaresProblem& problem) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < problem.is_free.size(); ++i)
    if (problem.is_free[i]) places.push_back(i);
  return places;
}

/// The smaller of two slopes on both sides of a number, 0 where they point apart: what is beside a
/// jump is not known as well as the jump is steep.
double lesser(double one, double other) {
  if (one * other <= 0) return 0;
  return std::abs(one) < std::abs(other) ? one : other;
}

enum class Slope { mean, lesser };

/// How deviations change with a number, on the side of a step.
arma::vec slope_of(const LeastSquaresProblem& problem, const Numbers& x, const Numbers& here,
                   std::size_t place, double step) {
  Numbers beside = x;
  beside[place] += step;
  arma::vec slope = (arma::vec(deviations_at(problem, beside)) - arma::vec(here)) / step;
  slope.transform([](double one) { return std::isfinite(one) ? one : 0; });
  return slope;
}

arma::mat slopes(const LeastSquaresProblem& problem, const Numbers& x, const Numbers& here,
                 const std::vector<std::size_t>& places, Slope kind) {
  arma::mat all(here.size(), places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    const ParameterPrior& prior = problem.priors[places[k]];
    const arma::vec up = slope_of(problem, x, here, places[k], prior.step);
    const arma::vec down = prior.is_smooth || x[places[k]] - prior.step < prior.least
                               ? up
                               : slope_of(problem, x, here, places[k], -prior.step);
    for (std::size_t i = 0; i < here.size(); ++i)
      all(i, k) = kind == Slope::mean ? (up(i) + down(i)) / 2 : lesser(up(i), down(i));
  }
  return all;
}

/// What a step of Gauss and Newton is made of.
struct Normal {
  arma::mat matrix;
  arma::vec gradient;
};

/// Of deviations at `x`, and how they change there, or near by.
Normal normal_of(const LeastSquaresProblem& problem, const Numbers& x, const Numbers& here,
                 const std::vector<std::size_t>& places, const arma::mat& slope) {
  const arma::vec deviations(here);
  arma::vec weights(deviations.n_elem);
  for (std::size_t i = 0; i < weights.n_elem; ++i)
    weights(i) = 1 / (1 + deviations(i) * deviations(i) / (cauchy_scale * cauchy_scale));
  Normal normal{slope.t() * arma::diagmat(weights) * slope, slope.t() * (weights % deviations)};
  for (std::size_t k = 0; k < places.size(); ++k) {
    const ParameterPrior& prior = problem.priors[places[k]];
    const double precision = 1 / (prior.deviation * prior.deviation);
    normal.matrix(k, k) += precision;
    normal.gradient(k) += precision * (x[places[k]] - prior.middle);
  }
  return normal;
}

Normal normal_of(const LeastSquaresProblem& problem, const Numbers& x,
                 const std::vector<std::size_t>& places, Slope kind) {
  const Numbers here = deviations_at(problem, x);
  return normal_of(problem, x, here, places, slopes(problem, x, here, places, kind));
}

/// Numbers are in units of many sizes: with these their matrix has a diagonal of 1.
arma::vec scale_of(const arma::mat& matrix) { return 1 / arma::sqrt(matrix.diag()); }
arma::mat scaled(const arma::mat& matrix, const arma::vec& scale) {
  return arma::diagmat(scale) * matrix * arma::diagmat(scale);
}

Covariance covariance_of(const Normal& normal, const std::vector<std::size_t>& places,
                         std::size_t all) {
  Covariance covariance(all);
  const arma::vec scale = scale_of(normal.matrix);
  const arma::mat inverse = arma::inv_sympd(scaled(normal.matrix, scale));
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = 0; k < places.size(); ++k)
      covariance(places[i], places[k]) = scale(i) * inverse(i, k) * scale(k);
  return covariance;
}

}  // namespace

double cost_of(const LeastSquaresProblem& problem, const Numbers& x, double most) {
  const double of_priors = cost_of_priors(problem, x);
  double of_deviations = 0;
  problem.visit_deviations(x, [&](double deviation) {
    of_deviations += loss_of(deviation);
    return !(of_deviations + of_priors > most);
  });
  const double cost = of_deviations + of_priors;
  return std::isfinite(cost) ? cost : std::numeric_limits<double>::max();
}

namespace {

/// The numbers a damped step further, or none where there is no step.
std::optional<Numbers> stepped(const Normal& normal, double damping, const Numbers& from,
                               const std::vector<std::size_t>& places) {
  arma::mat damped = normal.matrix;
  damped.diag() *= 1 + damping;
  const arma::vec scale = scale_of(damped);
  arma::vec move;
  if (!arma::solve(move, scaled(damped, scale), scale % normal.gradient,
                   arma::solve_opts::likely_sympd))
    return {};
  Numbers x = from;
  for (std::size_t k = 0; k < places.size(); ++k) x[places[k]] -= scale(k) * move(k);
  return x;
}

}  // namespace

LeastSquaresFit least_squares(const LeastSquaresProblem& problem, const Numbers& start,
                              int iterations) {
  const std::vector<std::size_t> places = free_numbers(problem);
  LeastSquaresFit fit{start, cost_of(problem, start)};
  double damping = 0.01;
  for (int i = 0; i < iterations; ++i) {
    const Normal normal = normal_of(problem, fit.x, places, Slope::mean);
    const double cost_before = fit.cost;
    constexpr int most_tries = 6;
    for (int tries = 0; tries < most_tries && fit.cost == cost_before; ++tries) {
      const auto x = stepped(normal, damping, fit.x, places);
      if (!x) return fit;
      const double cost = cost_of(problem, *x, fit.cost);
      const bool is_better = cost < fit.cost;
      damping *= is_better ? 0.2 : 5;
      if (is_better) fit = {*x, cost};
    }
    constexpr double no_matter = 0.02;
    if (cost_before - fit.cost < no_matter) break;
  }
  return fit;
}

Covariance covariance_at(const LeastSquaresProblem& problem, const Numbers& x) {
  const std::vector<std::size_t> places = free_numbers(problem);
  return covariance_of(normal_of(problem, x, places, Slope::lesser), places, x.size());
}

struct NearbySteps::Slopes {
  std::vector<std::size_t> places;
  arma::mat all;
};

NearbySteps::NearbySteps(const LeastSquaresProblem& problem, const Numbers& x)
    : problem_(problem), slopes_(std::make_unique<Slopes>()) {
  slopes_->places = free_numbers(problem);
  slopes_->all = slopes(problem, x, deviations_at(problem, x), slopes_->places, Slope::mean);
}
NearbySteps::~NearbySteps() = default;

Numbers NearbySteps::step_from(const Numbers& x) const {
  constexpr double damping = 0.01;
  const Normal normal =
      normal_of(problem_, x, deviations_at(problem_, x), slopes_->places, slopes_->all);
  return stepped(normal, damping, x, slopes_->places).value_or(x);
}

}  // namespace sim
