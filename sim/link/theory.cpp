#include "sim/link/theory.hpp"

#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

namespace sim {
namespace {

/// From here on an envelope is Gaussian to 1e-4 of a deviation: hypot(a, noise) = a + x + 1/(2 a).
constexpr double strong = 1000;

double log_bessel_i0(double x) {
  if (x < 500) return std::log(boost::math::cyl_bessel_i(0, x));
  return x - std::log(2 * std::numbers::pi * x) / 2 + std::log1p(1 / (8 * x) + 9 / (128 * x * x));
}

boost::math::non_central_chi_squared envelope_squared(double a) { return {2.0, a * a}; }

}  // namespace

double gaussian_q(double x) { return std::erfc(x / std::numbers::sqrt2) / 2; }

double gaussian_q_inverse(double p) { return std::numbers::sqrt2 * boost::math::erfc_inv(2 * p); }

double marcum_q1(double a, double b) {
  if (b == 0) return 1;  // Boost 1.74 says -0
  if (a == 0) return std::exp(-b * b / 2);
  if (a > strong) return gaussian_q(b - a - 1 / (2 * a));
  return boost::math::cdf(complement(envelope_squared(a), b * b));
}

double marcum_p1(double a, double b) {
  if (a == 0) return -std::expm1(-b * b / 2);
  if (a > strong) return gaussian_q(a + 1 / (2 * a) - b);
  return boost::math::cdf(envelope_squared(a), b * b);
}

double lit_amplitude(double ebn0) { return 2 * std::sqrt(ebn0); }

double coherent_ook_ber(double ebn0) { return gaussian_q(std::sqrt(ebn0)); }

double coherent_ook_ber_peak(double ebn0) { return gaussian_q(std::sqrt(ebn0 / 2)); }

double coherent_ook_ber(double ebn0, const OokThreshold& threshold) {
  const double t = threshold.deviations;
  return threshold.lit * gaussian_q(lit_amplitude(ebn0) - t) + (1 - threshold.lit) * gaussian_q(t);
}

double noncoherent_ook_ber(double ebn0, const OokThreshold& threshold) {
  const double t = threshold.deviations;
  return threshold.lit * marcum_p1(lit_amplitude(ebn0), t) + (1 - threshold.lit) * marcum_q1(0, t);
}

double optimum_envelope_threshold(double ebn0) {
  const double a = lit_amplitude(ebn0);
  if (a == 0) return std::numbers::sqrt2;  // the limit
  double low = a / 2, high = a / 2 + 2;    // I0(x) <= exp(x); t - a/2 falls from sqrt(2) to 0
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (log_bessel_i0(a * middle) < a * a / 2 ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace sim
