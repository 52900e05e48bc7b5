// Scenarios of location: from keys to settings, by any number of threads, beside the Cramer-Rao
// bound, and `cosys-sim locate` of one trial.
#include <cmath>
#include <nlohmann/json.hpp>

#include "counted_points.hpp"
#include "program.hpp"
#include "scenarios.hpp"
#include "sim/columns/columns_dataset.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/location/accuracy_report.hpp"
#include "sim/location/location_settings.hpp"
#include "sim/scenario/canonical_text.hpp"

namespace sim {
namespace {

const std::string location = "experiment = \"location\"\n";

LocationTrialsSettings settings_of(const std::string& text,
                                   const std::vector<std::string>& set = {}) {
  const LoadedScenario scenario = loaded(location + text, set);
  return location_settings(point_scenario(scenario, {}), scenario.places);
}

TEST(LocationScenario, EveryKeyArrives) {
  const LocationTrialsSettings s = settings_of(R"(
[location]
x_m = [0, 1]
y_m = 0.5
heading_deg = [10, 20]
relative_sigma = 0.03
sigma_mw_per_m2 = 0.4
bearing_sigma_deg = 5
device_x_m = 2
device_y_m = 1
device_yaw_deg = 190
intensity_unknown = true
area_m = [-1, 3, 0.1, 2]
trials = 77
[led]
current_ma = 50
height_mm = 12
elevation_deg = 3
[receiver]
height_mm = 20
yaw_deg = 5
tilt_deg = 2
[simulation]
seed = 9
)");
  ASSERT_EQ(s.readings.size(), 2U);
  const Reading& last = s.readings[1];
  EXPECT_EQ(last.receiver.x, 1);
  EXPECT_EQ(last.receiver.y, 0.5);
  EXPECT_EQ(last.receiver.z, 0.02);
  EXPECT_DOUBLE_EQ(last.receiver.yaw.value, dsp::degrees(25).value);
  EXPECT_DOUBLE_EQ(last.receiver.elevation.value, dsp::degrees(2).value);
  EXPECT_EQ(last.bearing_deviation.value, dsp::degrees(5).value);
  EXPECT_DOUBLE_EQ(last.deviation_w_per_m2, std::hypot(0.03 * last.irradiance_w_per_m2, 0.4e-3));
  EXPECT_EQ(last.irradiance_w_per_m2, received_light(s.locate.model, s.truth, last.receiver));
  EXPECT_EQ(s.truth.x, 2);
  EXPECT_EQ(s.truth.y, 1);
  EXPECT_FALSE(s.locate.model.all_round);
  EXPECT_EQ(s.locate.model.yaw.value, dsp::degrees(190).value);
  EXPECT_EQ(s.locate.model.elevation.value, dsp::degrees(3).value);
  EXPECT_EQ(s.locate.model.led_height_m, 0.012);
  EXPECT_TRUE(s.locate.intensity_unknown);
  EXPECT_EQ(s.locate.area->x_min, -1);
  EXPECT_EQ(s.locate.area->y_max, 2);
  EXPECT_EQ(s.trials, 77U);
  EXPECT_EQ(s.seed, 9U);
  const double full = settings_of("").locate.model.axial.value;
  EXPECT_LT(s.locate.model.axial.value, 0.6 * full);
}

TEST(LocationScenario, WithoutAYawItShinesToAllSidesWithoutASigmaThereAreNoBearings) {
  const LocationTrialsSettings s = settings_of("");
  EXPECT_TRUE(s.locate.model.all_round);
  EXPECT_FALSE(s.locate.area.has_value());
  for (const Reading& reading : s.readings) EXPECT_FALSE(reading.has_bearing());
}

TEST(LocationScenario, NumbersOfOneHoldForAllHeadingsOfARobot) {
  const auto s = settings_of("[location]\nx_m = 0\ny_m = 0\nheading_deg = [-40, 0, 40]\n");
  ASSERT_EQ(s.readings.size(), 3U);
  for (const Reading& reading : s.readings) EXPECT_EQ(reading.receiver.x, 0);
}

TEST(LocationScenario, ThreadsChangeNothing) {
  const LoadedScenario scenario = loaded(location + "[sweep]\nlocation.device_x_m = [1, 1.5]\n",
                                         {"location.trials=37", "floor.diffuse_reflectance=0"});
  const auto json = [&](int threads) {
    const auto points = counted_points(location_measurement, scenario, {.threads = threads});
    return dataset_json(dataset_of(scenario, "", location_columns(), points));
  };
  const std::string one = json(1);
  EXPECT_EQ(json(2), one);
  EXPECT_EQ(json(16), one);
}

TEST(LocationScenario, APointWithoutResultHasNoTrials) {
  const LoadedScenario scenario = loaded(location);
  const std::atomic<bool> stop{true};
  const auto points = counted_points(location_measurement, scenario, {.interrupt = &stop});
  EXPECT_EQ(dataset_of(scenario, "", location_columns(), points).n_runs, 0U);
}

TEST(LocationScenario, OtherErrorsAreAnotherDigest) {
  const auto digest = [](const std::string& seed) {
    const LoadedScenario scenario = loaded(
        location, {"simulation.seed=" + seed, "location.trials=3", "floor.diffuse_reflectance=0"});
    return dataset_digest(dataset_of(scenario, "", location_columns(),
                                     counted_points(location_measurement, scenario, {})));
  };
  EXPECT_NE(digest("2"), digest("3"));
}

TEST(LocationScenario, AListIsTheSamePointHoweverItIsTyped) {
  const auto text = [](const std::string& list) {
    return canonical_text(loaded(location, {"location.x_m=" + list}).base);
  };
  EXPECT_EQ(text("0,3,3,0"), text("0, 3.0, 30e-1, 0"));
  EXPECT_NE(text("0,3,3,0"), text("0,3,3,0.1"));
}

TEST(LocationScenario, MeasuredTheShippedOneReachesTheBoundWhereReadingsAreGood) {
  const LoadedScenario scenario = load_scenario(
      COSYS_SOURCE_DIR "/scenarios/location.toml",
      {"location.relative_sigma=0.01", "location.trials=400"}, {COSYS_SOURCE_DIR "/scenarios"});
  auto strict = location_measurement;
  strict.prepare = [](const Scenario& s, const SourceLocations& places, const Workers&) {
    LocationTrialsSettings settings = location_settings(s, places);
    settings.level = 0.999;
    return LocationBench(settings);
  };
  const auto points = counted_points(strict, scenario, {.threads = 2});
  ASSERT_EQ(points.size(), 3U);
  for (const auto& point : points) {
    const LocationTrials& result = point.result.value();
    EXPECT_EQ(result.count[0] + result.count[2], 400U);  // located, or a poor fit by chance
    EXPECT_LT(result.count[2], 5U);
    EXPECT_LE(result.rmse_m.low, result.bound_m());
    EXPECT_GE(result.rmse_m.high, result.bound_m());
    EXPECT_LT(result.rmse_m.high / result.rmse_m.low, 1.3);  // or nothing is compared
    EXPECT_LE(result.coverage.low, 0.95);
    EXPECT_GE(result.coverage.high, 0.95);
  }
}

std::string setting_refusal(const std::string& text) {
  try {
    settings_of("[location]\n" + text);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

TEST(LocationScenario, RefusesWhatCannotBeLocatedBy) {
  EXPECT_EQ(setting_refusal("x_m = [0, 1, 2]\ny_m = 0\nheading_deg = [0, 5]\n"),
            "location.heading_deg = 0,5 in x.toml:5 has 2 numbers (there are 3 receivers) give "
            "one or 3");
  EXPECT_EQ(setting_refusal("area_m = [0, 1, 2]\n"),
            "location.area_m = 0,1,2 in x.toml:3 (an area has four numbers) write x from,to and y "
            "from,to: -3,3,0,5");
  EXPECT_EQ(setting_refusal("area_m = [3, 0, 0, 1]\n"),
            "location.area_m = 3,0,0,1 in x.toml:3 (each range goes up) write x from,to and y "
            "from,to: -3,3,0,5");
  EXPECT_EQ(setting_refusal("device_x_m = 3\ndevice_y_m = 0.01\n"),
            "location.device_x_m = 3 in x.toml:3 with location.device_y_m = 0.01 in x.toml:4 (a "
            "receiver is 0.01 m from there) keep 0.05 m from all of them");
  EXPECT_EQ(setting_refusal("intensity_unknown = true\n"),
            "a device of unknown intensity (it could be anywhere) say in what area to look");
  EXPECT_EQ(setting_refusal("relative_sigma = 0\nsigma_mw_per_m2 = 0\n"),
            "reading 1 has a deviation of 0 W/m2 (it is above 0) give the noise that the reading "
            "has");
  EXPECT_EQ(setting_refusal("x_m = \"0:0.001:2\"\ny_m = 0\nheading_deg = 0\n"),
            "location.x_m of 2001 numbers in x.toml:3 (at most 1000 receivers are simulated) use "
            "fewer");
}

class LocationRun : public CommandLine {
 protected:
  LocationRun() {
    write("l.toml", location +
                        "title = \"l\"\n[location]\ntrials = 20\n[floor]\ndiffuse_reflectance = 0\n"
                        "[sweep]\nlocation.device_x_m = [1, 1.5]\n");
    write("line.toml", location +
                           "[location]\nx_m = [0, 1]\ny_m = 0\nheading_deg = 0\ndevice_x_m = 1.5\n"
                           "device_y_m = 0.8\ntrials = 20\n[floor]\ndiffuse_reflectance = 0\n");
  }

  nlohmann::json located(Words arguments) const {
    arguments.insert(arguments.begin(), {"locate", "l.toml", "--json"});
    const Outcome o = program(arguments);
    EXPECT_EQ(o.code, 0) << o.err;
    return nlohmann::json::parse(o.out);
  }
};

TEST_F(LocationRun, PrintsARowAPointAndWritesWhatXarrayOpens) {
  const Outcome table = program({"run", "l.toml", "-q"});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_EQ(std::ranges::count(table.out, '\n'), 3 + 2 + 1) << table.out;
  const Outcome json = program({"run", "l.toml", "--json", "-q"});
  write("l.json", json.out);
  EXPECT_EQ(tool("/usr/bin/python3",
                 {COSYS_SOURCE_DIR "/tests/sim/open_dataset_with_xarray.py", "l.h5", "l.json"}),
            "all readers agree\n");
  EXPECT_NE(json.out.find(digest_of(table.out)), std::string::npos);
}

TEST_F(LocationRun, MirrorImagesAreCountedAsAmbiguous) {
  const auto json = nlohmann::json::parse(program({"run", "line.toml", "--json", "-q"}).out);
  EXPECT_EQ(json["variables"]["n_outcomes"]["values"], (std::vector<int>{0, 20, 0, 0, 0}));
  EXPECT_TRUE(json["variables"]["rmse_m"]["values"][0].is_null());
}

TEST_F(LocationRun, LocateDrawsOneTrialOfAPoint) {
  const double at = located({"--point", "1"})["places"][0]["x_m"];
  EXPECT_NEAR(at, 1.5, 0.15);
  EXPECT_EQ(located({"--set", "location.device_x_m=1.5"})["places"][0]["x_m"], at);
  EXPECT_NE(located({"--point", "1", "--trial", "1"})["places"][0]["x_m"], at);
  EXPECT_NE(located({"--point", "1", "--seed", "2"})["places"][0]["x_m"], at);
  EXPECT_NEAR(located({})["places"][0]["x_m"].get<double>(), 1, 0.15);
}

TEST_F(LocationRun, LocateIsTheTrialThatRunCounts) {
  const Outcome run = program({"run", "l.toml", "--json", "-q", "--set", "location.trials=2",
                               "--set", "location.device_x_m=1.5"});
  const auto rmse = nlohmann::json::parse(run.out)["variables"]["rmse_m"]["values"][0];
  double squares = 0;
  for (const std::string trial : {"0", "1"}) {
    const auto place = located({"--point", "1", "--trial", trial})["places"][0];
    squares += std::pow(place["x_m"].get<double>() - 1.5, 2) +
               std::pow(place["y_m"].get<double>() - 0.5, 2);
  }
  EXPECT_NEAR(rmse.get<double>(), std::sqrt(squares / 2), 1e-6);  // by the prepared scattered light
}

TEST_F(LocationRun, WhatStaysOpenHasAnExitCodeOfItsOwn) {
  const Outcome o = program({"locate", "line.toml"});
  EXPECT_EQ(o.code, 4);
  EXPECT_EQ(o.out.substr(0, 11), "ambiguous: ");
}

TEST_F(LocationRun, LocateRefusesInOneLine) {
  write("p.toml", "experiment = \"presence\"\n");
  expect_refused({"locate", "p.toml"}, 2,
                 "p.toml (an experiment \"presence\" locates nothing) write experiment = "
                 "\"location\" before the first table");
  expect_refused({"locate", "l.toml", "--led", "TSAL6200"}, 2,
                 "--led with l.toml (a scenario says it by a key) leave it out");
  expect_refused({"locate", "l.toml", "--area", "0,1,0,1"}, 2,
                 "--area with l.toml (a scenario says it by a key) leave it out");
  expect_refused({"locate", "l.toml", "--point", "2"}, 2,
                 "--point 2 (the sweep has 2 points, counted from 0) use one from 0 to 1");
  expect_refused(
      {"locate", COSYS_SOURCE_DIR "/scenarios/readings/four_receivers.csv", "--seed", "2"}, 2,
      "--seed with " COSYS_SOURCE_DIR
      "/scenarios/readings/four_receivers.csv (readings "
      "are measured, not drawn) leave it out");
}

TEST_F(LocationRun, RefusesBeforeTheFirstTrial) {
  expect_refused(
      {"run", "l.toml", "-q", "--set", "location.device_x_m=1,3", "--set", "location.device_y_m=0"},
      2,
      "location.device_x_m = 3 in --set with location.device_y_m = 0 in --set (a "
      "receiver is 0 m from there) keep 0.05 m from all of them");
  expect_refused({"run", "l.toml", "-q", "--set", "ambient.daylight_lux=5"}, 2,
                 "ambient.daylight_lux in --set (it means nothing in the experiment \"location\") "
                 "remove it, or write experiment = \"link\" or \"arena\" or \"guard\" or "
                 "\"sharedlink\" or \"presence\" or \"listening\" before the first table");
}

}  // namespace
}  // namespace sim
