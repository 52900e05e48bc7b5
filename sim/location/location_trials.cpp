#include "sim/location/location_trials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/location/addressed_normals.hpp"
#include "sim/theory.hpp"
#include "sim/trial.hpp"

namespace sim {
namespace {

struct Errors {
  std::uint64_t n = 0;
  double squares = 0, fourth_powers = 0;  // m2, m4

  void add(double squared) {
    ++n;
    squares += squared;
    fourth_powers += squared * squared;
  }

  /// The mean square is normal for many trials, by the central limit theorem.
  Estimate rms(double level) const {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    if (n < 2) return {nothing, nothing, nothing};
    const double count = static_cast<double>(n), mean = squares / count;
    const double variance = std::max(0.0, fourth_powers / count - mean * mean) / (count - 1);
    const double z = gaussian_q_inverse((1 - level) / 2);
    const double margin = z * std::sqrt(variance);
    return {std::sqrt(mean), std::sqrt(std::max(0.0, mean - margin)), std::sqrt(mean + margin)};
  }
};

double bound(const LocationTrialsSettings& s) {
  const auto covariance =
      cramer_rao_bound(s.locate.model, s.readings, s.truth, s.locate.intensity_unknown);
  return covariance ? covariance->rms() : std::numeric_limits<double>::infinity();
}

void judge(const Location& location, const Position& truth, LocationTrials& result,
           Errors& errors) {
  ++result.count.at(static_cast<std::size_t>(location.outcome));
  if (location.outcome != LocateOutcome::located) return;
  const Place& best = location.places.front();
  const double dx = best.at.at.x - truth.x, dy = best.at.at.y - truth.y;
  errors.add(dx * dx + dy * dy);
  result.covered += squared_deviations(*best.covariance, dx, dy) <= chi_square_95 ? 1 : 0;
}

}  // namespace

std::vector<Reading> noiseless_readings(const LightModel& model, std::vector<Reading> readings,
                                        const Position& device) {
  for (Reading& reading : readings) {
    reading.irradiance_w_per_m2 = received_light(model, device, reading.receiver);
    reading.bearing = {};
    if (reading.has_bearing()) reading.bearing = dsp::Radians(bearing_error(reading, device));
  }
  return readings;
}

std::vector<Reading> drawn_readings(std::vector<Reading> noiseless, const TrialAddress& address) {
  const dsp::RandomAddress draws{address.seed, address.point, address.trial,
                                 static_cast<std::uint32_t>(Purpose::reading_noise)};
  const std::vector<float> normals = addressed_normals(draws, 2 * noiseless.size());
  std::size_t next = 0;
  const auto normal = [&] { return static_cast<double>(normals[next++]); };
  for (Reading& reading : noiseless) {
    reading.irradiance_w_per_m2 += reading.deviation_w_per_m2 * normal();
    reading.bearing += reading.bearing_deviation * normal();
  }
  return noiseless;
}

LocationTrials measure_location(const LocationTrialsSettings& s) {
  const auto readings = noiseless_readings(s.locate.model, s.readings, s.truth);
  Locator locator(s.locate, readings);
  locator.prepare(readings);
  LocationTrials result;
  Errors errors;
  for (std::uint32_t trial = 0; trial < s.trials; ++trial) {
    const auto drawn = drawn_readings(readings, {s.seed, s.point, trial});
    judge(locator.locate(drawn), s.truth, result, errors);
  }
  result.bound_m = bound(s);
  result.rmse_m = errors.rms(s.level);
  const Interval ci =
      clopper_pearson(static_cast<double>(result.covered), static_cast<double>(errors.n), s.level);
  result.coverage = {ratio(result.covered, errors.n), ci.low, ci.high};
  return result;
}

}  // namespace sim
