#pragma once
// The mean of what is skewed and never below 0, such as squared errors: a few large ones make the
// mean and its spread together, so that an interval to both sides alike ends too low too often.
#include <cstdint>

#include "sim/counting/statistics.hpp"

namespace sim {

/// Sums of the first four powers.
class SkewedMean {
 public:
  void add(double value);

  std::uint64_t n() const { return n_; }
  double sum() const { return first_; }

  /// The mean with its interval: that of Hall's transformation of Student's ratio (On the removal
  /// of skewness by transformation, J. R. Statist. Soc. B 54 (1992) 221-228, the cubic one), by
  /// Student's t of as many degrees of freedom as the spread is worth where tails are long (Box,
  /// Non-normality and tests on variances, Biometrika 40 (1953) 318-335). Of fewer than two values
  /// all three are NaN.
  Estimate estimate(double level) const;

 private:
  std::uint64_t n_ = 0;
  double first_ = 0, second_ = 0, third_ = 0, fourth_ = 0;
};

}  // namespace sim
