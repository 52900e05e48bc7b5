#include "sim/location/location_trials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/counting/skewed_mean.hpp"
#include "sim/noise/addressed_normals.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

/// What one trial came to.
struct Judged {
  LocateOutcome outcome;
  double squared_m2 = 0;  // of the error of a located one
  bool covered = false, in_region = false;
};

/// In the order of the trials, so that sums are the same however they were shared out.
using Lot = std::vector<Judged>;

Estimate share_of(std::uint64_t part, std::uint64_t whole, double level) {
  const Interval ci = clopper_pearson(static_cast<double>(part), static_cast<double>(whole), level);
  return {ratio(part, whole), ci.low, ci.high};
}

LocationTrials summed(const std::vector<Lot>& lots, double level) {
  LocationTrials result;
  SkewedMean errors;
  std::uint64_t in_region = 0;
  for (const Lot& lot : lots)
    for (const Judged& trial : lot) {
      ++result.count.at(static_cast<std::size_t>(trial.outcome));
      if (trial.outcome != LocateOutcome::located) continue;
      errors.add(trial.squared_m2);
      result.covered += trial.covered ? 1 : 0;
      in_region += trial.in_region ? 1 : 0;
    }
  result.squared_um2 = errors.sum() * 1e12;
  const Estimate square = errors.estimate(level);
  result.rmse_m = {std::sqrt(square.value), std::sqrt(square.low), std::sqrt(square.high)};
  result.coverage = share_of(result.covered, errors.n(), level);
  result.region_coverage = share_of(in_region, errors.n(), level);
  return result;
}

/// Receivers and noiseless readings, ready for any number of trials.
struct Bench {
  explicit Bench(const LocationTrialsSettings& s)
      : readings(noiseless_readings(s.locate.model, s.readings, s.truth)),
        locator(s.locate, readings) {
    locator.prepare(readings);
  }
  std::vector<Reading> readings;
  Locator locator;
};

std::vector<Reading> drawn(const Bench& bench, const LocationTrialsSettings& s,
                           std::uint32_t trial) {
  return drawn_readings(bench.readings, {s.seed, s.point, trial});
}

Judged judged(const Bench& bench, const LocationTrialsSettings& s, std::uint32_t trial) {
  const std::vector<Reading> readings = drawn(bench, s, trial);
  const Location location = bench.locator.locate(readings);
  if (location.outcome != LocateOutcome::located) return {location.outcome};
  const LocatedPlace& best = location.places.front();
  const double dx = best.at.at.x - s.truth.x, dy = best.at.at.y - s.truth.y;
  return {location.outcome, dx * dx + dy * dy,
          squared_deviations(*best.covariance, dx, dy) <= chi_square_95,
          bench.locator.region_holds(location, readings, s.truth)};
}

}  // namespace

std::uint64_t LocationTrials::trials() const {
  return std::accumulate(count.begin(), count.end(), std::uint64_t{0});
}

double LocationTrials::bound_m() const {
  return bound ? bound->rms() : std::numeric_limits<double>::infinity();
}

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

std::optional<LocationTrials> measure_location(const LocationTrialsSettings& s,
                                               const Workers& workers) {
  const Bench bench(s);
  RunSharing<Lot> trials(shared_trials(s.trials, workers), [&](std::uint32_t first, int n) {
    Lot lot;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n) && !workers.interrupted(); ++i)
      lot.push_back(judged(bench, s, first + i));
    return lot;
  });
  const std::vector<Lot> lots = trials();
  if (lots.empty()) return std::nullopt;
  LocationTrials result = summed(lots, s.level);
  result.bound = cramer_rao_bound(s.locate.model, s.readings, s.truth, s.locate.intensity_unknown);
  return result;
}

LocationTrials measure_location(const LocationTrialsSettings& s) {
  return measure_location(s, {}).value();
}

Location locate_trial(const LocationTrialsSettings& s, std::uint32_t trial) {
  const Bench bench(s);
  const std::vector<Reading> readings = drawn(bench, s, trial);
  Location location = bench.locator.locate(readings);
  bench.locator.add_regions(location, readings);
  return location;
}

std::vector<Location> locate_first_trials(const LocationTrialsSettings& s, std::uint32_t trials) {
  const Bench bench(s);
  std::vector<Location> locations;
  for (std::uint32_t trial = 0; trial < trials; ++trial)
    locations.push_back(bench.locator.locate(drawn(bench, s, trial)));
  return locations;
}

}  // namespace sim
