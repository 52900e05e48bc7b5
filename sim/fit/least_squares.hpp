#pragma once
// The most likely numbers of a problem of deviations that bend and jump: Levenberg and Marquardt's
// way, with differences over steps that are wide enough to see what a jump hides, and Cauchy's loss
// for what no number explains.
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "sim/fit/rule_parameters.hpp"

namespace sim {

struct LeastSquaresProblem {
  /// Gives the deviations at numbers to a function, one after the other, until that says no.
  std::function<void(const Numbers&, const std::function<bool(double)>&)> visit_deviations;
  std::vector<ParameterPrior> priors;
  std::vector<bool> is_free;
};

/// Of numbers, each with each.
class Covariance {
 public:
  explicit Covariance(std::size_t numbers = 0) : numbers_(numbers), all_(numbers * numbers) {}
  double& operator()(std::size_t i, std::size_t k) { return all_[i * numbers_ + k]; }
  double operator()(std::size_t i, std::size_t k) const { return all_[i * numbers_ + k]; }

 private:
  std::size_t numbers_;
  std::vector<double> all_;
};

struct LeastSquaresFit {
  Numbers x;
  double cost = 0;  // with the priors'
};

/// Of all deviations, and of how far the numbers are from what is known before. Where it is beyond
/// `most` it is only known to be: the deviations behind the one that tells it are not looked at.
double cost_of(const LeastSquaresProblem& problem, const Numbers& x, double most = HUGE_VAL);

LeastSquaresFit least_squares(const LeastSquaresProblem& problem, const Numbers& start,
                              int iterations);

/// Steps of Gauss and Newton from several places, with the slopes of one that is near to all: each
/// looks at the deviations once.
class NearbySteps {
 public:
  NearbySteps(const LeastSquaresProblem& problem, const Numbers& x);
  ~NearbySteps();
  Numbers step_from(const Numbers& x) const;

 private:
  struct Slopes;
  const LeastSquaresProblem& problem_;
  std::unique_ptr<Slopes> slopes_;
};

/// Of the free numbers; zeros in the rows of the others. A number that a jump holds from one side
/// alone counts as not held.
Covariance covariance_at(const LeastSquaresProblem& problem, const Numbers& x);

}  // namespace sim
