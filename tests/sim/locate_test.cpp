// Location by intensity and bearing: exact without noise, as good as the bound with noise, and
// silent about nothing that readings leave open.
#include "sim/location/locate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "location_scenes.hpp"
#include "sim/failure.hpp"
#include "sim/location/location_trials.hpp"

namespace sim {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

LocateSettings settings_for(const LightModel& model) {
  LocateSettings settings;
  settings.model = model;
  return settings;
}

void expect_at(const Location& location, const Position& device, double within) {
  ASSERT_EQ(location.outcome, LocateOutcome::located);
  ASSERT_EQ(location.places.size(), 1U);
  EXPECT_NEAR(location.places[0].at.at.x, device.x, within);
  EXPECT_NEAR(location.places[0].at.at.y, device.y, within);
}

TEST(Locate, IsExactWithoutNoise) {
  const LightModel model = inverse_square();
  for (const Position device : {Position{1.1, 0.7}, Position{2.6, 1.8}, Position{0.3, 0.2}}) {
    const auto readings = readings_of(model, device, four_corners());
    expect_at(locate(settings_for(model), readings), device, 1e-6);
  }
}

TEST(Locate, IsExactOnAFloorThatScatters) {
  LightModel model = indoors();
  model.all_round = true;
  const Position device{1.1, 0.7};
  const auto readings = readings_of(model, device, four_corners());
  const Location location = locate(settings_for(model), readings);
  expect_at(location, device, 1e-5);  // patches of the scattered light
  EXPECT_EQ(location.degrees_of_freedom, 2);
}

TEST(Locate, IsExactByHeadingsOfOneRobot) {  // which tell the direction by the lens's pattern
  LightModel model = indoors();
  model.all_round = true;
  const Position device{1.4, 0.5};
  const auto readings = readings_of(model, device, headings(0, 0, {-40, 0, 40, 80}));
  expect_at(locate(settings_for(model), readings), device, 1e-5);
}

TEST(Locate, FindsABeamsPlaceWhereItsYawIsKnown) {
  LightModel model = indoors();
  model.yaw = dsp::degrees(20);
  const Position device{-1.5, -0.4};
  const auto readings = readings_of(model, device,
                                    {receiver_at(0, 0, 180), receiver_at(0, 0.5, 190),
                                     receiver_at(-0.2, -0.3, 170), receiver_at(0.3, 0.4, 200)});
  expect_at(locate(settings_for(model), readings), device, 1e-4);
}

TEST(Locate, FindsTheIntensityToo) {
  const LightModel model = inverse_square();
  const Position device{1.1, 0.7};
  auto readings = readings_of(model, device, four_corners());
  for (Reading& r : readings) r.irradiance_w_per_m2 *= 0.3;
  LocateSettings settings = settings_for(model);
  settings.intensity_unknown = true;
  settings.area = Area{-1, 4, -1, 3};
  const Location location = locate(settings, readings);
  expect_at(location, device, 1e-6);
  EXPECT_NEAR(location.places[0].at.intensity, 0.3, 1e-6);
  EXPECT_EQ(location.degrees_of_freedom, 1);
}

TEST(Locate, TwoReceiversOnALineSeeTheMirrorImageAsWell) {
  const LightModel model = inverse_square();
  const Position device{1.5, 0.8};
  const auto readings = readings_of(model, device, {receiver_at(0, 0, 0), receiver_at(1, 0, 0)});
  const Location location = locate(settings_for(model), readings);
  ASSERT_EQ(location.outcome, LocateOutcome::ambiguous);
  ASSERT_EQ(location.places.size(), 2U);
  for (const LocatedPlace& place : location.places) {
    EXPECT_NEAR(place.at.at.x, 1.5, 1e-6);
    EXPECT_NEAR(std::abs(place.at.at.y), 0.8, 1e-6);
  }
  EXPECT_LT(location.places[0].at.at.y * location.places[1].at.at.y, 0);
}

TEST(Locate, SoTheyDoWhereTheFloorScattersFarMoreThanADeviation) {
  LightModel model = indoors();
  model.all_round = true;
  const auto readings =
      readings_of(model, {1.5, 0.3},
                  {receiver_at(0, 0, 0), receiver_at(1, 0, 0), receiver_at(1.3, 0, 0),
                   receiver_at(0.6, 0, 0), receiver_at(-2, 0, 0)},
                  3e-5);
  const Location location = locate(settings_for(model), readings);
  EXPECT_EQ(location.outcome, LocateOutcome::ambiguous);
  EXPECT_EQ(location.places.size(), 2U);
}

/// From three times the distance d the slope of 1/d^2 leads four times as far back, beyond the
/// receiver, where there is less light than at the start.
TEST(Locate, StepsThatWouldOvershootAreHalved) {
  const LightModel model = inverse_square();
  const auto readings = readings_of(model, {0.4, 0}, {receiver_at(0, 0, 0)});
  const LeastSquares problem{model, readings, {-9, 9, -9, 9}};
  const Minimum minimum =
      descend(problem, scattered_light(model, readings, {0.4, 0}), {{1.2, 0}, 1});
  EXPECT_TRUE(minimum.converged);
  EXPECT_NEAR(minimum.at.at.x, 0.4, 1e-6);
}

TEST(Locate, ABearingTellsTheSides) {
  const LightModel model = inverse_square();
  const Position device{1.5, 0.8};
  auto readings = readings_of(model, device, {receiver_at(0, 0, 0), receiver_at(1, 0, 0)});
  add_bearings(readings, device, 5);
  expect_at(locate(settings_for(model), readings), device, 1e-6);
}

TEST(Locate, AnAreaTellsTheSides) {
  const LightModel model = inverse_square();
  const Position device{1.5, 0.8};
  LocateSettings settings = settings_for(model);
  settings.area = Area{-3, 3, 0.1, 3};
  const auto readings = readings_of(model, device, {receiver_at(0, 0, 0), receiver_at(1, 0, 0)});
  expect_at(locate(settings, readings), device, 1e-6);
}

TEST(Locate, OneReadingIsARing) {
  const LightModel model = inverse_square();
  const Location location =
      locate(settings_for(model), readings_of(model, {1.5, 0.8}, {receiver_at(0, 0, 0)}));
  EXPECT_EQ(location.outcome, LocateOutcome::underdetermined);
  ASSERT_EQ(location.places.size(), 1U);
  const Position& at = location.places[0].at.at;
  EXPECT_NEAR(std::hypot(at.x, at.y), std::hypot(1.5, 0.8), 1e-4);
  EXPECT_FALSE(location.places[0].covariance.has_value());
}

TEST(Locate, TheSameReadingTwiceIsStillARing) {
  const LightModel model = inverse_square();
  const auto readings =
      readings_of(model, {1.5, 0.8}, {receiver_at(0, 0, 0), receiver_at(0, 0, 0)});
  EXPECT_EQ(locate(settings_for(model), readings).outcome, LocateOutcome::underdetermined);
}

TEST(Locate, ReadingsOfNoSinglePlaceAreAPoorFit) {
  const LightModel model = inverse_square();
  auto readings = readings_of(model, {1.1, 0.7}, four_corners());
  readings[2].irradiance_w_per_m2 *= 1.5;  // fifty deviations
  const Location location = locate(settings_for(model), readings);
  EXPECT_EQ(location.outcome, LocateOutcome::poor_fit);
  EXPECT_LT(location.probability, 1e-3);
}

TEST(Locate, APlaceOutsideOfTheAreaIsNotReached) {
  const LightModel model = inverse_square();
  LocateSettings settings = settings_for(model);
  settings.area = Area{2, 3, 1.5, 2};
  const Location location = locate(settings, readings_of(model, {1.1, 0.7}, four_corners()));
  EXPECT_EQ(location.outcome, LocateOutcome::not_converged);
  EXPECT_TRUE(location.places.empty());
}

std::string refusal_of(const LocateSettings& settings, const std::vector<Reading>& readings) {
  try {
    locate(settings, readings);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

// With the ambient light taken off, noise makes a photodiode that looks away read below 0.
TEST(Locate, TakesReadingsThatNoiseMadeNegative) {
  const LocateSettings settings = settings_for(inverse_square());
  auto readings = readings_of(settings.model, {1.1, 0.7}, four_corners());
  Reading away = readings[0];
  away.receiver.yaw += dsp::degrees(180);
  away.irradiance_w_per_m2 = -away.deviation_w_per_m2;
  readings.push_back(away);
  const Location location = locate(settings, readings);
  ASSERT_EQ(location.outcome, LocateOutcome::located);
  EXPECT_NEAR(location.places[0].at.at.x, 1.1, 1e-4);
  EXPECT_NEAR(location.places[0].at.at.y, 0.7, 1e-4);
  EXPECT_NEAR(location.places[0].chi_square, 1, 1e-3);
}

TEST(Locate, RefusesReadingsThatCannotBe) {
  const LocateSettings settings = settings_for(inverse_square());
  const auto good = readings_of(settings.model, {1.1, 0.7}, four_corners());
  auto readings = good;
  readings[1].irradiance_w_per_m2 = nan;
  EXPECT_EQ(refusal_of(settings, readings),
            "reading 2 of nan W/m2 (light is a number) leave failures out");
  readings = good;
  readings[0].deviation_w_per_m2 = 0;
  EXPECT_EQ(refusal_of(settings, readings),
            "reading 1 has a deviation of 0 W/m2 (it is above 0) give the noise that the reading "
            "has");
  readings[0].deviation_w_per_m2 = 1e-8 * readings[0].irradiance_w_per_m2;
  EXPECT_EQ(refusal_of(settings, readings),
            "reading 1 has a deviation of 1e-08 of itself (the model is good to 1e-07) give the "
            "noise that the reading has");
  readings = good;
  readings[3].receiver.x = nan;
  EXPECT_EQ(refusal_of(settings, readings),
            "reading 4 (place, heading and bearing are numbers) leave failures out");
  EXPECT_EQ(refusal_of(settings, {}), "no readings (there is nothing to locate by) add some");
  LocateSettings anywhere = settings;
  anywhere.intensity_unknown = true;
  EXPECT_EQ(refusal_of(anywhere, good),
            "a device of unknown intensity (it could be anywhere) say in what area to look");
}

LocationTrialsSettings trials_of(const LightModel& model, const Position& truth,
                                 const std::vector<channel::Pose>& receivers, double share) {
  LocationTrialsSettings s;
  s.locate = settings_for(model);
  s.truth = truth;
  s.readings = readings_of(model, truth, receivers, share);
  s.trials = 2000;
  s.level = 0.9999;
  return s;
}

/// All located, rms error within the interval around the bound, 95 % of ellipses with the truth.
void expect_efficient(const LocationTrialsSettings& settings) {
  const LocationTrials result = measure_location(settings);
  EXPECT_EQ(result.count[0] + result.count[2], settings.trials);  // located, or a poor fit ...
  EXPECT_LT(result.count[2], 12U);  // ... by chance: 1 in 1000, so 2 +- 1.4
  EXPECT_LE(result.rmse_m.low, result.bound_m());
  EXPECT_GE(result.rmse_m.high, result.bound_m());
  EXPECT_LT(result.rmse_m.high / result.rmse_m.low, 1.2);  // or nothing is compared
  EXPECT_LE(result.coverage.low, 0.95);
  EXPECT_GE(result.coverage.high, 0.95);
}

TEST(LocationTrials, MeasuredFourReceiversReachTheBound) {
  expect_efficient(trials_of(inverse_square(), {1.1, 0.7}, four_corners(), 0.01));
}

TEST(LocationTrials, MeasuredHeadingsOfOneRobotReachTheBound) {
  LightModel model = indoors();
  model.all_round = true;
  auto s = trials_of(model, {1.4, 0.5}, headings(0, 0, {-40, 0, 40, 80}), 0.01);
  s.trials = 1000;
  expect_efficient(s);
}

TEST(LocationTrials, MeasuredIntensityAndBearingReachTheBound) {
  const Position truth{1, 0.5};
  auto s = trials_of(inverse_square(), truth, {receiver_at(0, 0, 0), receiver_at(0, 1, 0)}, 0.02);
  add_bearings(s.readings, truth, 1);
  expect_efficient(s);
}

TEST(LocationTrials, MeasuredUnknownIntensityReachesItsBound) {
  auto s = trials_of(inverse_square(), {1.1, 0.7}, four_corners(), 0.01);
  s.locate.intensity_unknown = true;
  s.locate.area = Area{-1, 4, -1, 3};
  s.trials = 1000;
  expect_efficient(s);
}

TEST(LocationTrials, MirrorImagesAreCountedAsAmbiguous) {
  auto s =
      trials_of(inverse_square(), {1.5, 0.8}, {receiver_at(0, 0, 0), receiver_at(1, 0, 0)}, 0.01);
  s.trials = 100;
  const LocationTrials result = measure_location(s);
  EXPECT_EQ(result.count[static_cast<std::size_t>(LocateOutcome::ambiguous)], 100U);
  EXPECT_TRUE(std::isnan(result.rmse_m.value));
}

TEST(LocationTrials, AreTheSameAgainAndOtherForAnotherSeed) {
  auto s = trials_of(inverse_square(), {1.1, 0.7}, four_corners(), 0.01);
  s.trials = 50;
  const double one = measure_location(s).rmse_m.value, again = measure_location(s).rmse_m.value;
  EXPECT_EQ(one, again);
  s.seed = 2;
  EXPECT_NE(measure_location(s).rmse_m.value, one);
}

}  // namespace
}  // namespace sim
