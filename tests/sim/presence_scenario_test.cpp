// Scenarios of presence: from keys to settings, by any number of threads, beside the closed form.
#include <cmath>

#include "counted_points.hpp"
#include "program.hpp"
#include "scenarios.hpp"
#include "sim/columns/columns_dataset.hpp"
#include "sim/columns/columns_table.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/location/presence_point.hpp"
#include "sim/location/presence_report.hpp"
#include "sim/location/presence_settings.hpp"
#include "sim/scenario/canonical_text.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

const std::string presence = "experiment = \"presence\"\n";

PresenceSettings settings_of(const std::string& text, const std::vector<std::string>& set = {}) {
  const LoadedScenario scenario = loaded(presence + text, set);
  return presence_settings(point_scenario(scenario, {}), scenario.places);
}

TEST(PresenceScenario, AnEmptyOneHasTheDefaultsOfItsSettings) {
  const PresenceSettings s = settings_of(""), defaults;
  EXPECT_EQ(s.detector, defaults.detector);
  EXPECT_EQ(s.tuned_to.value, defaults.tuned_to.value);
  EXPECT_EQ(s.window_samples, defaults.window_samples);
  EXPECT_EQ(s.reference_samples, 0U);  // Goertzel needs none
  EXPECT_FALSE(s.keyed.has_value());
  EXPECT_EQ(s.pfa, defaults.pfa);
  EXPECT_EQ(s.trials, defaults.trials);
  EXPECT_EQ(s.seed, defaults.seed);
  EXPECT_EQ(s.meter.feedback_ohm, defaults.meter.feedback_ohm);
  EXPECT_EQ(s.meter.temperature_k, defaults.meter.temperature_k);
  EXPECT_EQ(s.meter.sample_rate_hz, defaults.meter.sample_rate_hz);
  EXPECT_EQ(s.meter.aperture, defaults.meter.aperture);
  EXPECT_EQ(s.meter.adc_bits, defaults.meter.adc_bits);
  EXPECT_EQ(s.meter.full_scale_v, defaults.meter.full_scale_v);
  EXPECT_EQ(s.meter.noise_scale, defaults.meter.noise_scale);
  EXPECT_EQ(s.light.carrier.value, defaults.light.carrier.value);
  EXPECT_EQ(s.light.duty, defaults.light.duty);
}

TEST(PresenceScenario, EveryKeyArrives) {
  const PresenceSettings s = settings_of(R"(
[presence]
detector = "dc-difference"
tuned_hz = 58000
window_ms = 5
reference_ms = 7.5
keyed = true
false_alarm = [0.2, 0.02]
trials = 77
feedback_ohm = 2e6
adc_rate_hz = 100000
adc_bits = 14
adc_full_scale_v = 3.3
aperture = 0.25
[device]
message = "X 1"
baud = 1200
clock_error_ppm = 1000
carrier_hz = 60000
carrier_error_ppm = -500
carrier_duty = 0.25
[receiver]
temperature_c = 35
[ambient]
irradiance_w_per_m2 = 0.25
[noise]
scale = 3
[simulation]
seed = 9
)");
  EXPECT_EQ(s.detector, Detector::dc_difference);
  EXPECT_EQ(s.tuned_to.value, 58000);
  EXPECT_EQ(s.window_samples, 500U);
  EXPECT_EQ(s.reference_samples, 750U);
  EXPECT_EQ(s.keyed.value().message, "X 1");
  EXPECT_DOUBLE_EQ(s.keyed.value().baud.value, 1201.2);
  EXPECT_EQ(s.pfa, (std::vector<double>{0.2, 0.02}));
  EXPECT_EQ(s.trials, 77U);
  EXPECT_EQ(s.seed, 9U);
  EXPECT_EQ(s.meter.feedback_ohm, 2e6);
  EXPECT_EQ(s.meter.temperature_k, 308.15);
  EXPECT_EQ(s.meter.sample_rate_hz, 1e5);
  EXPECT_EQ(s.meter.adc_bits, 14);
  EXPECT_EQ(s.meter.full_scale_v, 3.3);
  EXPECT_EQ(s.meter.aperture, 0.25);
  EXPECT_EQ(s.meter.noise_scale, 3);
  EXPECT_EQ(s.light.ambient.value, 0.25);
  EXPECT_DOUBLE_EQ(s.light.carrier.value, 59970);
  EXPECT_EQ(s.light.duty, 0.25);
}

/// A floor that gives nothing back: E = I / d^2, 72.3 mW/sr at 100 mA (Vishay 81010).
const std::vector<std::string> no_floor{"floor.refractive_index=1", "floor.diffuse_reflectance=0"};

TEST(PresenceScenario, TheLightIsThatOfThePhotodiodesDirectivity) {
  const auto light = [](std::vector<std::string> set) {
    set.insert(set.end(), no_floor.begin(), no_floor.end());
    return settings_of("", set).light.signal.value;
  };
  const double ahead = light({"receiver.range_m=5"});
  EXPECT_NEAR(light({"receiver.range_m=10"}), ahead / 4, 1e-4 * ahead);
  // Half sensitivity of a BPW34 at 65 degrees (Vishay 81521).
  EXPECT_NEAR(light({"receiver.range_m=5", "receiver.yaw_deg=65"}), ahead / 2, 1e-6 * ahead);
  EXPECT_EQ(light({"receiver.range_m=5", "module.q=4"}), ahead);
}

TEST(PresenceScenario, WithoutNoiseOnlyRoundingIsLeft) {
  PresenceSettings s = settings_of("", {"noise.scale=0", "presence.trials=1"});
  EXPECT_NEAR(measure_presence(s).noise_over_step, 1 / std::sqrt(12), 1e-12);
  s.meter.noise_scale = 1;
  const double once = channel::noise_volts(s.meter, 1);
  s.meter.noise_scale = 2;
  EXPECT_DOUBLE_EQ(channel::noise_volts(s.meter, 1), 2 * once);
}

TEST(PresenceScenario, CarriesItsPhotodiodeWhoseNumbersArePhysics) {
  const LoadedScenario scenario = loaded(presence);
  EXPECT_NE(scenario.text.find("\"photodiodes/bpw34.toml\""), std::string::npos);
  EXPECT_EQ(loaded("").text.find("photodiodes/"), std::string::npos);
  const LoadedScenario alone = parse_scenario(scenario.text, "x.toml", {}, {});
  EXPECT_EQ(alone.base.photodiode.name, "BPW34");
  EXPECT_EQ(canonical_text(alone.base), canonical_text(scenario.base));
  std::string text = scenario.text;
  const std::string area = "area_mm2 = { value = 7.5";
  text.replace(text.find(area), area.size(), "area_mm2 = { value = 7.4");
  const LoadedScenario other = parse_scenario(text, "x.toml", {}, {});
  EXPECT_EQ(other.base.photodiode.area_mm2, 7.4);
  EXPECT_NE(canonical_text(other.base), canonical_text(scenario.base));
}

TEST(PresenceScenario, SweepsPhotodiodes) {
  const LoadedScenario scenario = loaded(presence + "[sweep]\npresence.photodiode = \"*\"\n");
  EXPECT_EQ(scenario.sweep.at(0).labels, std::vector<std::string>{"BPW34"});
  EXPECT_EQ(point_scenario(scenario, {0}).photodiode.name, "BPW34");
}

TEST(PresenceScenario, ThreadsChangeNothing) {
  const LoadedScenario scenario =
      loaded(presence + "[sweep]\npresence.detector = \"*\"\nreceiver.range_m = [40, 60]\n",
             {"presence.trials=61", "presence.window_ms=1", "presence.reference_ms=1"});
  const auto json = [&](int threads) {
    const auto points = counted_points(presence_measurement, scenario, {.threads = threads});
    return dataset_json(dataset_of(scenario, "", presence_columns(), points));
  };
  const std::string one = json(1);
  EXPECT_EQ(json(2), one);
  EXPECT_EQ(json(16), one);
}

TEST(PresenceScenario, AnInterruptBeforeAllReachesNoPoint) {
  const std::atomic<bool> stop{true};
  const LoadedScenario scenario = loaded(presence);
  for (const auto& point : counted_points(presence_measurement, scenario, {.interrupt = &stop}))
    EXPECT_FALSE(point.reached());
}

TEST(PresenceScenario, PointsWithoutResultAreZerosOfADataset) {
  const LoadedScenario scenario = loaded(presence);
  const std::atomic<bool> stop{true};
  const auto points = counted_points(presence_measurement, scenario, {.interrupt = &stop});
  ASSERT_EQ(points.size(), 1U);
  const Dataset data = dataset_of(scenario, "", presence_columns(), points);
  EXPECT_EQ(data.n_runs, 0U);
  for (const auto& variable : data.variables) {
    const auto* counts = std::get_if<std::vector<std::int64_t>>(&variable.values);
    if (counts == nullptr) continue;
    const std::int64_t nothing = variable.is_choice ? no_choice : 0;
    EXPECT_EQ(std::ranges::count(*counts, nothing), std::ssize(*counts)) << variable.facts.name;
  }
}

const std::filesystem::path shipped_scenario = COSYS_SOURCE_DIR "/scenarios/presence.toml";

TEST(PresenceScenario, TheShippedOneCountsWhatTheClosedFormSays) {
  const LoadedScenario scenario =
      load_scenario(shipped_scenario, {"presence.trials=400"}, {COSYS_SOURCE_DIR "/scenarios"});
  int between = 0;
  auto strict = presence_measurement;
  strict.prepare = [](const Scenario& s, const SourceLocations& places, const Workers&) {
    PresenceSettings settings = presence_settings(s, places);
    settings.level = 0.99995;  // of each of 126 intervals
    return PresenceBench(settings);
  };
  for (const auto& point : counted_points(strict, scenario, {.threads = 2})) {
    EXPECT_GT(point.result->noise_over_step, 0.5);
    EXPECT_EQ(point.result->clipped, 0);
    for (const RocPoint& roc : point.result->roc) {
      EXPECT_LE(roc.false_alarm.low, roc.pfa);
      EXPECT_GE(roc.false_alarm.high, roc.pfa);
      EXPECT_LE(roc.detection.low, roc.detection_theory);
      EXPECT_GE(roc.detection.high, roc.detection_theory);
      between += roc.detection_theory > 0.1 && roc.detection_theory < 0.95 ? 1 : 0;
    }
  }
  EXPECT_GT(between, 20);  // or nothing is compared
}

std::string setting_refusal(const std::string& text) {
  try {
    settings_of(text);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

TEST(PresenceScenario, RefusesWhatCannotBeMeasured) {
  EXPECT_EQ(setting_refusal("[presence]\nwindow_ms = 0.01\n"),
            "presence.window_ms = 0.01 in x.toml:3 (at presence.adc_rate_hz = 200000 it is 2 "
            "samples) use 0.02 to 1000 ms");
  EXPECT_EQ(setting_refusal("[presence]\nreference_ms = 5000\n"), "accepted");  // not used
  EXPECT_EQ(setting_refusal("[presence]\nreference_ms = 5000\ndetector = \"dc-difference\"\n"),
            "presence.reference_ms = 5000 in x.toml:3 (at presence.adc_rate_hz = 200000 it is "
            "1000000 samples) use 0.02 to 1000 ms");
  EXPECT_EQ(setting_refusal("[presence]\nfalse_alarm = [0.1, 0.01, 0.1]\n"),
            "presence.false_alarm = 0.1,0.01,0.1 in x.toml:3 (one is there twice) remove one of "
            "the two");
  EXPECT_EQ(setting_refusal("[presence]\nadc_rate_hz = 29500\n"),
            "presence.tuned_hz = 59000 with presence.adc_rate_hz = 29500 (to it the carrier looks "
            "like steady light) take another sample rate");
  EXPECT_EQ(setting_refusal("[presence]\nkeyed = true\nwindow_ms = 500\n"),
            "presence.window_ms = 500 (the message's light ends after 281.7 ms) take a shorter "
            "window or a longer device.message");
  EXPECT_EQ(setting_refusal("[presence]\nfalse_alarm = \"0.001:0.001:0.2\"\n"),
            "presence.false_alarm of 200 numbers in x.toml:3 (each has columns of its own) use 100 "
            "at most");
  EXPECT_EQ(setting_refusal("[presence]\nfalse_alarm = [0.1, 0]\n"),
            "presence.false_alarm = 0 in x.toml:3 (probabilities of false alarm that thresholds "
            "are set for must be at least 1e-09) use a value 1e-09 to 0.999");
  EXPECT_EQ(
      setting_refusal("[presence]\nphotodiode = \"BPW35\"\n"),
      "presence.photodiode = \"BPW35\" in x.toml:3 (no photodiode of this name in " COSYS_SOURCE_DIR
      "/scenarios/photodiodes) did you mean bpw34?");
}

/// The row of a point of few samples, coarsely rounded.
std::string row_of(const std::vector<std::string>& set) {
  const LoadedScenario scenario = loaded(presence, set);
  const PresencePointRun point = counted_points(presence_measurement, scenario, {}).at(0);
  return PointTable(presence_columns(), scenario, point).row(point);
}

// Sums of few rounded samples have few values, however white rounding is: of 4 samples with 0.6
// steps of noise 5 in a deviation, and the share of false alarms is off by half of itself.
TEST(PresenceScenario, SaysWhereRoundingSpoilsTheClosedForm) {
  const std::vector<std::string> fine{"presence.trials=10", "presence.adc_bits=13"};
  const auto with = [&](const std::string& one) {
    auto set = fine;
    set.push_back(one);
    return row_of(set);
  };
  EXPECT_EQ(row_of(fine).find("steps"), std::string::npos);
  EXPECT_NE(with("presence.window_ms=0.02").find("steps"), std::string::npos);
  EXPECT_NE(with("presence.adc_bits=11").find("steps"), std::string::npos);
}

// At twice the carrier there are phases at which each sample sees half of a cycle's light.
TEST(PresenceScenario, APhaseToWhichTheReplicaIsBlindFindsNothing) {
  PresenceSettings s = settings_of(
      "", {"presence.detector=synchronous", "presence.adc_rate_hz=118000", "presence.window_ms=1",
           "ambient.irradiance_w_per_m2=900", "device.carrier_duty=0.5"});
  const PresencePoint point(s);
  EXPECT_NEAR(point.law(0.25, 0).signal, 0, 1e-6);
  EXPECT_GT(point.law(0, 0).signal, 1e-3);
}

class PresenceRun : public CommandLine {
 protected:
  PresenceRun() {
    write("p.toml", presence +
                        "title = \"p\"\n[presence]\nwindow_ms = 1\nreference_ms = 1\ntrials = 50\n"
                        "[sweep]\npresence.detector = \"*\"\nreceiver.range_m = [40, 60]\n");
  }
};

TEST_F(PresenceRun, PrintsARowAPointAndWritesWhatXarrayOpens) {
  const Outcome table = program({"run", "p.toml", "-q"});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_NE(table.out.find("Pd at Pfa = 0.01 "), std::string::npos) << table.out;
  EXPECT_EQ(std::ranges::count(table.out, '\n'), 3 + 6 + 1) << table.out;
  const Outcome json = program({"run", "p.toml", "--json", "-q"});
  write("p.json", json.out);
  EXPECT_EQ(tool("/usr/bin/python3",
                 {COSYS_SOURCE_DIR "/tests/sim/open_dataset_with_xarray.py", "p.h5", "p.json"}),
            "all readers agree\n");
  EXPECT_NE(json.out.find(digest_of(table.out)), std::string::npos);
}

TEST_F(PresenceRun, ShowsTheRocOfASinglePoint) {
  const Outcome one = program({"run", "p.toml", "-q", "--set", "presence.detector=goertzel",
                               "--set", "receiver.range_m=50"});
  EXPECT_EQ(one.code, 0) << one.err;
  EXPECT_NE(one.out.find("false alarm,"), std::string::npos) << one.out;
}

TEST_F(PresenceRun, RefusesWhatMeansNothingInIt) {
  expect_refused({"run", "p.toml", "--set", "receiver.module=TSOP4856"}, 2,
                 "receiver.module in --set (it means nothing in the experiment \"presence\") "
                 "remove it, or write experiment = \"link\" or \"arena\" or \"guard\" or "
                 "\"sharedlink\" or \"listening\" before the first table");
  expect_refused({"run", "p.toml", "--set", "disturbance.lamp.kind=ripple"}, 2,
                 "disturbance.lamp.kind in --set (it means nothing in the experiment \"presence\") "
                 "remove it, or write experiment = \"link\" or \"arena\" or \"guard\" or "
                 "\"sharedlink\" or \"listening\" before the first table");
  expect_refused({"run", "p.toml", "--set", "presence.window_ms=0.01"}, 2,
                 "presence.window_ms = 0.01 in --set (at presence.adc_rate_hz = 200000 it is 2 "
                 "samples) use 0.02 to 1000 ms");
}

}  // namespace
}  // namespace sim
