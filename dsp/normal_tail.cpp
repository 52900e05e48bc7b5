#include "dsp/normal_tail.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dsp {

namespace {

constexpr double far_out = 10;  // from here on the continued fraction is short

double log_density(double x) {
  constexpr double log_sqrt_2pi = 0.91893853320467274;
  return -x * x / 2 - log_sqrt_2pi;
}

double upper_tail(double x) { return std::erfc(x / std::numbers::sqrt2) / 2; }

/// ln of upper_tail(x), x < far_out, also where that is nearly 1.
double near_log_upper_tail(double x) {
  return x < 0 ? std::log1p(-upper_tail(-x)) : std::log(upper_tail(x));
}

/// 1 / (x + 2 / (x + 3 / (x + ...))), x >= far_out.
double far_mean_excess(double x) {
  constexpr int terms = 16;
  double fraction = 0;
  for (int k = terms; k > 0; --k) fraction = k / (x + fraction);
  return fraction;
}

/// The normal exceeded with probability exp(log_level), at most 1/2: Hastings' approximation
/// (Abramowitz & Stegun 26.2.23, error below 4.5e-4), then Halley's method on the logarithm.
double upper_quantile(double log_level) {
  const double t = std::sqrt(-2 * log_level);
  double x = t - (2.515517 + t * (0.802853 + t * 0.010328)) /
                     (1 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
  for (int step = 0; step < 2; ++step) {
    const NormalTail tail = normal_tail(x);
    const double newton = (tail.log_probability - log_level) / tail.hazard;
    x += newton / (1 + newton * tail.mean_excess / 2);
  }
  return x;
}

}  // namespace

NormalTail normal_tail(double bound) {
  if (bound < far_out) {
    const double probability = upper_tail(bound);
    const double hazard = std::exp(log_density(bound)) / probability;
    return {near_log_upper_tail(bound), hazard, hazard - bound};
  }
  const double excess = far_mean_excess(bound), hazard = bound + excess;
  return {log_density(bound) - std::log(hazard), hazard, excess};
}

double log_upper_tail(double bound) {
  return bound < far_out ? near_log_upper_tail(bound) : normal_tail(bound).log_probability;
}

double truncated_normal_quantile(double bound, double level) {
  const double below = (1 - level) + level * upper_tail(-bound);  // P(X <= result)
  const double x = below < 0.5 ? -upper_quantile(std::log(below))
                               : upper_quantile(std::log(level) + log_upper_tail(bound));
  return std::max(bound, x);
}

}  // namespace dsp
