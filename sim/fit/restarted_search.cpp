#include "sim/fit/restarted_search.hpp"

#include <armadillo>
#include <cmath>
#include <random>
#include <utility>

namespace sim {
namespace {

/// Numbers that spread by the covariance of those that are drawn.
class Spread {
 public:
  Spread(LeastSquaresProblem problem, const Numbers& x, const std::vector<bool>& drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i)
      if (drawn[i]) places_.push_back(i);
    problem.is_free = drawn;
    const Covariance all = covariance_at(problem, x);
    arma::mat covariance(places_.size(), places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i)
      for (std::size_t k = 0; k < places_.size(); ++k)
        covariance(i, k) = all(places_[i], places_[k]);
    if (!arma::chol(root_, covariance, "lower")) places_.clear();
  }

  Numbers around(Numbers x) {
    arma::vec normals(places_.size());
    for (double& one : normals) one = normal();
    const arma::vec move = root_ * normals;
    for (std::size_t i = 0; i < places_.size(); ++i) x[places_[i]] += move(i);
    return x;
  }

  bool is_empty() const { return places_.empty(); }

 private:
  /// By Box and Muller's way, the same in each library.
  double normal() {
    const double length = std::sqrt(-2 * std::log(uniform()));
    return length * std::cos(2 * M_PI * uniform());
  }
  /// Between 0 and 1, neither of both.
  double uniform() {
    constexpr double steps = 1ULL << 32;
    return (static_cast<double>(random_()) + 0.5) / steps;
  }

  std::vector<std::size_t> places_;
  arma::mat root_;
  std::mt19937 random_{1};
};

}  // namespace

Numbers restarted_search(const LeastSquaresProblem& problem, const Numbers& x,
                         const std::vector<bool>& drawn, const std::function<bool(int)>& go_on) {
  constexpr int first_iterations = 2, more_iterations = 5;
  constexpr double far = 60;  // from the best: not even more iterations make up for it
  LeastSquaresFit best{x, cost_of(problem, x)};
  Spread spread(problem, x, drawn);
  for (int starts = 0; !spread.is_empty() && go_on(starts); ++starts) {
    LeastSquaresFit fit = least_squares(problem, spread.around(best.x), first_iterations);
    if (fit.cost > best.cost + far) continue;
    fit = least_squares(problem, fit.x, more_iterations);
    if (fit.cost < best.cost) best = std::move(fit);
  }
  return best.x;
}

}  // namespace sim
