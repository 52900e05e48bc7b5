#include "sim/counting/event_rate.hpp"

#include <algorithm>
#include <boost/math/special_functions/gamma.hpp>

#include "sim/counting/quantiles.hpp"

namespace sim {
namespace {

/// Of what is counted in whole events, for it begins and ends anywhere in a rhythm: that of
/// rounding (Sheppard's correction).
constexpr double least_variance = 1.0 / 12;

/// So many would scatter as these if they came by chance. What is seen to scatter less than by
/// chance is worth its own number at least, however few the stretches are.
double independent_events(const EventSums& sums, double level) {
  const double n = static_cast<double>(sums.stretches), events = static_cast<double>(sums.events);
  const double mean = events / n;
  const double squares = static_cast<double>(sums.squared) - events * mean;
  const double dispersion = std::max(squares / (n - 1), least_variance) / mean;
  const double narrowing = normal_quantile(level) / student_quantile(n - 1, level);
  const double scattered = events / dispersion * narrowing * narrowing;
  return dispersion < 1 ? std::max(events, scattered) : scattered;
}

}  // namespace

Estimate event_rate(const EventSums& sums, double exposure, double level) {
  const Estimate by_chance = poisson_rate(sums.events, exposure, level);
  if (sums.events == 0 || sums.stretches < 2 || !(exposure > 0)) return by_chance;
  const double n = independent_events(sums, level), tail = (1 - level) / 2;
  return {by_chance.value, by_chance.value * boost::math::gamma_p_inv(n, tail) / n,
          by_chance.value * boost::math::gamma_q_inv(n + 1, tail) / n};
}

}  // namespace sim
