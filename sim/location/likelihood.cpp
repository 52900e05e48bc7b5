#include "sim/location/likelihood.hpp"

#include <cmath>
#include <limits>

namespace sim {
namespace {

constexpr double impossible = std::numeric_limits<double>::infinity();

}  // namespace

double Likelihood::operator()(const Position& at) const {
  const std::vector<Reading>& readings = problem_.readings;
  if (!problem_.area.contains(at) || nearest_receiver(readings, at) < least_distance_m)
    return impossible;
  std::vector<double> light;
  for (std::size_t i = 0; i < readings.size(); ++i)
    light.push_back(ray_light(problem_.model, at, readings[i].receiver) + scattered_.of(i, at));
  return (problem_.deviations_are_shares ? of_shares(light) : of_intensities(light)) +
         of_bearings(at);
}

/// With the factor that least squares gives, in deviations.
double Likelihood::of_intensities(const std::vector<double>& light) const {
  double measured = 0, both = 0, predicted = 0;  // sums of products
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Reading& reading = problem_.readings[i];
    const double y = reading.irradiance_w_per_m2 / reading.deviation_w_per_m2;
    const double f = light[i] / reading.deviation_w_per_m2;
    measured += y * y;
    both += y * f;
    predicted += f * f;
  }
  const double factor = problem_.intensity_unknown ? both / predicted : 1;
  if (!(factor > 0)) return impossible;
  return measured - 2 * factor * both + factor * factor * predicted;
}

/// Each deviation is a share s of the light E itself: ((y - E) / (s E))^2 + 2 ln E a reading, which
/// is least where 1 / factor is the root of a quadratic equation.
double Likelihood::of_shares(const std::vector<double>& light) const {
  double ratios = 0, squared_ratios = 0, weights = 0, logarithms = 0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Reading& reading = problem_.readings[i];
    if (!(light[i] > 0)) return impossible;
    const double y = reading.irradiance_w_per_m2;
    const double s = reading.deviation_w_per_m2 / y, ratio_in_shares = y / light[i] / s;
    ratios += ratio_in_shares / s;
    squared_ratios += ratio_in_shares * ratio_in_shares;
    weights += 1 / (s * s);
    logarithms += std::log(light[i]);
  }
  const double n = static_cast<double>(light.size());
  const double inverse =
      problem_.intensity_unknown
          ? (ratios + std::sqrt(ratios * ratios + 4 * n * squared_ratios)) / (2 * squared_ratios)
          : 1;
  return inverse * inverse * squared_ratios - 2 * inverse * ratios + weights +
         2 * (logarithms - n * std::log(inverse));
}

double Likelihood::of_bearings(const Position& at) const {
  double sum = 0;
  for (const Reading& reading : problem_.readings) {
    if (!reading.has_bearing()) continue;
    const double turned = bearing_error(reading, at) / reading.bearing_deviation.value;
    sum += turned * turned;
  }
  return sum;
}

}  // namespace sim
