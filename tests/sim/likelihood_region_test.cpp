// The region that the likelihood leaves a device: where light is a straight line it is the ellipse
// of the covariance, elsewhere it holds the truth where that ellipse does not.
#include "sim/location/likelihood_region.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "held_intervals.hpp"
#include "location_scenes.hpp"
#include "scenarios.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/location/location_settings.hpp"
#include "sim/location/location_trials.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

LocateSettings of_model(const LightModel& model) {
  LocateSettings settings;
  settings.model = model;
  return settings;
}

/// From the centre of the region's ellipse, in half axes: below 1 inside.
double in_half_axes(const LikelihoodRegion& region, const Position& place) {
  const double dx = place.x - region.centre.x, dy = place.y - region.centre.y;
  const double c = std::cos(region.ellipse.direction.value);
  const double s = std::sin(region.ellipse.direction.value);
  return std::hypot((c * dx + s * dy) / region.ellipse.semi_major_m,
                    (c * dy - s * dx) / region.ellipse.semi_minor_m);
}

TEST(LikelihoodRegion, IsTheCovariancesEllipseWhereErrorsAreSmall) {
  const LightModel model = inverse_square();
  const Location location =
      locate(of_model(model), readings_of(model, {1.1, 0.7}, four_corners(), 1e-4));
  ASSERT_EQ(location.outcome, LocateOutcome::located);
  const LocatedPlace& place = location.places[0];
  ASSERT_TRUE(place.region.has_value());
  const ErrorEllipse e = error_ellipse(*place.covariance), found = place.region->ellipse;
  EXPECT_NEAR(found.semi_major_m, e.semi_major_m, 2e-3 * e.semi_major_m);
  EXPECT_NEAR(found.semi_minor_m, e.semi_minor_m, 2e-3 * e.semi_minor_m);
  EXPECT_NEAR(found.direction.value, e.direction.value, 2e-3);
  EXPECT_NEAR(distance(place.region->centre, place.at.at), 0, 1e-2 * e.semi_minor_m);
  for (const Position& at : place.region->outline)
    EXPECT_NEAR(squared_deviations(*place.covariance, at.x - place.at.at.x, at.y - place.at.at.y),
                chi_square_95, 0.05);
}

// Where light is measured to a tenth its distance is known by a share, so a region reaches farther
// away from a receiver than towards it, and its centre is farther than the place.
TEST(LikelihoodRegion, ReachesFartherAwayThanTowards) {
  const LightModel model = inverse_square();
  std::vector<Reading> readings = readings_of(model, {1, 0}, {receiver_at(0, 0, 0)}, 0.3);
  add_bearings(readings, {1, 0}, 2);
  const Location location = locate(of_model(model), readings);
  ASSERT_EQ(location.outcome, LocateOutcome::located);
  const auto& region = location.places[0].region.value();
  const auto [left, right] = std::ranges::minmax(region.outline, {}, &Position::x);
  const double deviations = std::sqrt(chi_square_95) * 0.3;
  EXPECT_NEAR(left.x, 1 / std::sqrt(1 + deviations), 2e-3);
  EXPECT_NEAR(right.x, 1 / std::sqrt(1 - deviations), 2e-3);
  EXPECT_GT(region.centre.x, 1.1);
}

TEST(LikelihoodRegion, EndsAtTheAreasEdge) {
  const LightModel model = inverse_square();
  LocateSettings settings = of_model(model);
  settings.area = Area{-3, 1.6, 0.1, 3};
  const auto readings =
      readings_of(model, {1.5, 0.8}, {receiver_at(0, 0, 0), receiver_at(1, 0, 0)}, 0.1);
  const Location location = locate(settings, readings);
  ASSERT_EQ(location.outcome, LocateOutcome::located);
  double farthest = 0;
  for (const Position& at : location.places[0].region.value().outline) {
    EXPECT_TRUE(settings.area->contains(at));
    farthest = std::max(farthest, at.x);
  }
  EXPECT_NEAR(farthest, 1.6, 1e-3);
}

TEST(LikelihoodRegion, EachPlaceOfSeveralHasItsOwn) {
  const LightModel model = inverse_square();
  const Position device{1.5, 0.8};
  const auto readings = readings_of(model, device, {receiver_at(0, 0, 0), receiver_at(1, 0, 0)});
  const Location location = locate(of_model(model), readings);
  ASSERT_EQ(location.places.size(), 2U);
  for (const LocatedPlace& place : location.places)
    EXPECT_EQ(in_half_axes(place.region.value(), device) < 1, place.at.at.y > 0);
}

TEST(LikelihoodRegion, OfACurveOfPlacesThereIsNone) {
  const LightModel model = inverse_square();
  const Location location =
      locate(of_model(model), readings_of(model, {1.5, 0.8}, {receiver_at(0, 0, 0)}));
  EXPECT_EQ(location.outcome, LocateOutcome::underdetermined);
  EXPECT_FALSE(location.places[0].region.has_value());
}

// ---- how often they hold the truth ----

/// Beyond `high` where no ellipse that is printed holds the truth; none where none is printed.
std::optional<held::Printed> nearest_of(const Location& location, const Position& truth) {
  if (location.outcome != LocateOutcome::located && location.outcome != LocateOutcome::ambiguous)
    return std::nullopt;
  double least = std::numeric_limits<double>::infinity();
  for (const LocatedPlace& place : location.places)
    if (place.region) least = std::min(least, in_half_axes(*place.region, truth));
  return held::Printed{0, 1, least};
}

/// The shipped scenario's first point, on a floor that scatters nothing, for speed.
LocationTrialsSettings shipped_with(std::vector<std::string> set) {
  set.emplace_back("floor.diffuse_reflectance=0");
  const LoadedScenario scenario = load_scenario(COSYS_SOURCE_DIR "/scenarios/location.toml", set,
                                                {COSYS_SOURCE_DIR "/scenarios"});
  return location_settings(point_scenario(scenario, point_coordinates(scenario.sweep, 0)),
                           scenario.places);
}

std::vector<std::string> device_at(const std::string& x, const std::string& share) {
  return {"location.device_x_m=" + x, "location.relative_sigma=" + share};
}

std::vector<std::string> of_unknown_intensity(const std::string& x, const std::string& share,
                                              const std::string& area) {
  auto set = device_at(x, share);
  set.insert(set.end(), {"location.intensity_unknown=true", "location.area_m=" + area});
  return set;
}

/// What `locate` prints of a trial.
held::Experiment trial_of(const std::vector<std::string>& set) {
  const LocationTrialsSettings s = shipped_with(set);
  const auto noiseless = noiseless_readings(s.locate.model, s.readings, s.truth);
  return [s, noiseless, locator = Locator(s.locate, noiseless)](std::uint64_t seed) {
    const auto readings = drawn_readings(noiseless, {seed, 0, 0});
    Location location = locator.locate(readings);
    locator.add_regions(location, readings);
    return nearest_of(location, s.truth);
  };
}

TEST(HeldIntervals, MeasuredOfPlaces) {
  // At 0.1 the ellipse of the covariance is found out by the gate's.
  const auto gate_seeds = [](const std::string& share) { return share == "0.1" ? 250 : 60; };
  const std::string ellipse = "ellipse of a place", good_to = ", readings good to ";
  for (const std::string share : {"0.01", "0.03", "0.1"})
    held::expect_to_hold({ellipse, ".3 m from a wall" + good_to + share, gate_seeds(share)},
                         trial_of(device_at("0.3", share)));
  for (const std::string share : {"0.01", "0.03", "0.1"})
    held::expect_to_hold({ellipse, "intensity unknown" + good_to + share, gate_seeds(share)},
                         trial_of(of_unknown_intensity("0.3", share, "0,3,0,2")));
  held::expect_to_hold({ellipse, "intensity unknown, mostly several places" + good_to + "0.03", 50},
                       trial_of(of_unknown_intensity("0.9", "0.03", "-1,4,-1,3")));
}

// Of a wall's skewed errors; the rms error that it should hold is that of 196 000 trials.
TEST(HeldIntervals, MeasuredOfTheRmsErrorAtAWall) {
  constexpr double rms_error_m = 0.1357;
  LocationTrialsSettings s = shipped_with(device_at("0.3", "0.1"));
  const auto experiment = [&s](std::uint64_t seed) {
    s.seed = seed;
    const Estimate error = measure_location(s).rmse_m;
    return held::Printed{error.low, error.high, rms_error_m};
  };
  held::expect_to_hold({"rms error", ".3 m from a wall, 200 trials of readings good to 0.1", 5},
                       experiment);
}

/// Readings of a file whose deviations are computed of the reading itself.
held::Experiment file_of(double share) {
  return [=](std::uint64_t seed) {
    const Position truth{0.3, 0.5};
    LocateSettings settings = of_model(inverse_square());
    settings.deviations_are_shares = true;
    auto readings =
        drawn_readings(readings_of(settings.model, truth, four_corners(), share), {seed, 0, 0});
    for (Reading& r : readings) r.deviation_w_per_m2 = share * r.irradiance_w_per_m2;
    return nearest_of(locate(settings, readings), truth);
  };
}

TEST(HeldIntervals, MeasuredOfPlacesByRelativeSigma) {
  held::expect_to_hold(
      {"ellipse of a place", "a file's relative_sigma of 0.1, .3 m from a wall", 100},
      file_of(0.1));
}

}  // namespace
}  // namespace sim
