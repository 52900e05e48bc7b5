#include "sim/location/location_trials.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/counting/skewed_mean.hpp"
#include "sim/noise/addressed_normals.hpp"
#include "sim/threads/parallel_runs.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

Estimate root_of(const Estimate& square) {
  return {std::sqrt(square.value), std::sqrt(square.low), std::sqrt(square.high)};
}

Estimate share_of(std::uint64_t part, std::uint64_t whole, double level) {
  const Interval ci = clopper_pearson(static_cast<double>(part), static_cast<double>(whole), level);
  return {ratio(part, whole), ci.low, ci.high};
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

LocationTally& LocationTally::operator+=(const LocationTally& next) {
  trials.insert(trials.end(), next.trials.begin(), next.trials.end());
  return *this;
}

LocationBench::LocationBench(const LocationTrialsSettings& settings)
    : settings_(settings),
      readings_(noiseless_readings(settings.locate.model, settings.readings, settings.truth)),
      locator_(settings.locate, readings_),
      bound_(cramer_rao_bound(settings.locate.model, settings.readings, settings.truth,
                              settings.locate.intensity_unknown)) {
  locator_.prepare(readings_);
}

std::vector<Reading> LocationBench::drawn(std::uint32_t trial) const {
  return drawn_readings(readings_, {settings_.seed, settings_.point, trial});
}

LocationTrial LocationBench::judged(std::uint32_t trial) const {
  const std::vector<Reading> readings = drawn(trial);
  const Location location = locator_.locate(readings);
  if (location.outcome != LocateOutcome::located) return {location.outcome};
  const LocatedPlace& best = location.places.front();
  const double dx = best.at.at.x - settings_.truth.x, dy = best.at.at.y - settings_.truth.y;
  return {location.outcome, dx * dx + dy * dy,
          squared_deviations(*best.covariance, dx, dy) <= chi_square_95,
          locator_.region_holds(location, readings, settings_.truth)};
}

LocationTrials LocationBench::summed(const LocationTally& tally) const {
  LocationTrials result;
  result.bound = bound_;
  SkewedMean errors;
  std::uint64_t in_region = 0;
  for (const LocationTrial& trial : tally.trials) {
    ++result.count.at(static_cast<std::size_t>(trial.outcome));
    if (trial.outcome != LocateOutcome::located) continue;
    errors.add(trial.squared_m2);
    result.covered += trial.covered ? 1 : 0;
    in_region += trial.in_region ? 1 : 0;
  }
  const double level = settings_.level;
  result.squared_um2 = errors.sum() * 1e12;
  result.rmse_m = root_of(errors.estimate(level));
  result.coverage = share_of(result.covered, errors.n(), level);
  result.region_coverage = share_of(in_region, errors.n(), level);
  return result;
}

Estimate rms_error_m(const LocationTally& tally, double level) {
  SkewedMean errors;
  for (const LocationTrial& trial : tally.trials)
    if (trial.outcome == LocateOutcome::located) errors.add(trial.squared_m2);
  return root_of(errors.estimate(level));
}

LocationTally run_location(const LocationBench& bench, std::uint32_t first, int n,
                           const std::atomic<bool>* stop) {
  LocationTally tally;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n) && !is_stopped(stop); ++i)
    tally.trials.push_back(bench.judged(first + i));
  return tally;
}

LocationTrials measure_location(const LocationTrialsSettings& s) {
  const LocationBench bench(s);
  return bench.summed(run_location(bench, 0, static_cast<int>(s.trials)));
}

Location locate_trial(const LocationTrialsSettings& s, std::uint32_t trial) {
  const LocationBench bench(s);
  const std::vector<Reading> readings = bench.drawn(trial);
  Location location = bench.locator().locate(readings);
  bench.locator().add_regions(location, readings);
  return location;
}

std::vector<Location> locate_first_trials(const LocationTrialsSettings& s, std::uint32_t trials) {
  const LocationBench bench(s);
  std::vector<Location> locations;
  for (std::uint32_t trial = 0; trial < trials; ++trial)
    locations.push_back(bench.locator().locate(bench.drawn(trial)));
  return locations;
}

}  // namespace sim
