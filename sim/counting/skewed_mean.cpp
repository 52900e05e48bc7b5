#include "sim/counting/skewed_mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/counting/quantiles.hpp"

namespace sim {
namespace {

/// Of a ratio t of n values with this skewness, whose transform is t: the root of Hall's
/// t + a t^2 + a^2 t^3 / 3 + a / 2, with a = skewness / (3 root n).
double hall_inverse(double transformed, double skewness, double n) {
  const double a = skewness / (3 * std::sqrt(n));
  if (std::abs(a) < 1e-9) return transformed;
  return (std::cbrt(1 + 3 * a * (transformed - a / 2)) - 1) / a;
}

/// Of the variance of n values, which scatters the more the longer their tails are.
double degrees_of_freedom(double n, double excess_kurtosis) {
  return 2 / (2 / (n - 1) + std::max(0.0, excess_kurtosis) / n);
}

}  // namespace

void SkewedMean::add(double value) {
  ++n_;
  first_ += value;
  second_ += value * value;
  third_ += value * value * value;
  fourth_ += value * value * value * value;
}

Estimate SkewedMean::estimate(double level) const {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  if (n_ < 2) return {unknown, unknown, unknown};
  const double n = static_cast<double>(n_), mean = first_ / n, m = mean * mean;
  const double variance = second_ / n - m;  // central moments from here on
  if (!(variance > 0)) return {mean, mean, mean};
  const double third = third_ / n - 3 * mean * second_ / n + 2 * m * mean;
  const double fourth = fourth_ / n - 4 * mean * third_ / n + 6 * m * second_ / n - 3 * m * m;
  const double skewness = third / (variance * std::sqrt(variance));
  const double freedom = degrees_of_freedom(n, fourth / (variance * variance) - 3);
  const double t = student_quantile(std::max(1.0, freedom), level);
  const double error = std::sqrt(variance / (n - 1));
  return {mean, std::max(0.0, mean - error * hall_inverse(t, skewness, n)),
          mean - error * hall_inverse(-t, skewness, n)};
}

}  // namespace sim
