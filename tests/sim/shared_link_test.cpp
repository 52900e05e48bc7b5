// SharedLink by light: what two nodes tell each other, and that each hears itself.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "counted_points.hpp"
#include "gtest/gtest.h"
#include "sim/columns/columns_dataset.hpp"
#include "sim/command/experiments.hpp"
#include "sim/failure.hpp"
#include "sim/link/link.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/shared_link/shared_link.hpp"
#include "sim/shared_link/shared_link_report.hpp"
#include "sim/shared_link/station.hpp"
#include "tests/sim/scenarios.hpp"

namespace sim {
namespace {

const std::string nodes = R"(
experiment = "sharedlink"
[receiver]
module = "TSSP4056"
range_m = 2
[exchange]
duration_s = 20
runs = 2
)";

SharedLinkPoint only_point(const std::vector<std::string>& set = {}) {
  const auto points = counted_points(shared_link_measurement, loaded(nodes, set));
  EXPECT_EQ(points.size(), 1U);
  return points.front();
}

/// Turns so rare that they seldom meet.
const std::vector<std::string> patient{"exchange.interval_min_ms=2000",
                                       "exchange.interval_max_ms=4000", "exchange.duration_s=60"};

TEST(SharedLinkSetup, InGoodLightEverythingArrives) {
  const DirectionTally all = together(
      only_point(with_keys(patient, {"exchange.query_every_s=5", "exchange.query_timeout_s=10"}))
          .tally);
  EXPECT_GT(all.n_sent, 40U);
  EXPECT_GE(all.n_accepted + 2, all.n_sent);
  EXPECT_LT(static_cast<double>(all.n_bit_errors), 0.01 * static_cast<double>(all.n_bits));
  EXPECT_GT(all.n_asked, 20U);
  EXPECT_GE(all.n_answered + all.n_timed_out + 4, all.n_asked) << "all but those under way";
  EXPECT_GT(all.n_answered, all.n_asked * 3 / 4);
}

TEST(SharedLinkSetup, MeasuredNodesWaitWhileTheOtherIsHeard) {
  // With pauses of 0.1 to 0.9 s and messages of 0.3 to 0.7 s half of them would meet.
  const DirectionTally all =
      together(only_point({"exchange.compressed=false", "exchange.duration_s=60"}).tally);
  EXPECT_GT(all.n_sent, 120U);
  EXPECT_LT(static_cast<double>(all.n_sent - all.n_accepted),
            0.05 * static_cast<double>(all.n_sent));
}

TEST(SharedLinkSetup, MeasuredAgesCountFromTheTurnThatBroughtTheValue) {
  // Without compression each turn brings all values: a turn of B's comes every 1 to 2 s, and its
  // message takes 0.67 s, so values are no younger than that when they come.
  const DirectionTally all = together(
      only_point({"exchange.compressed=false", "exchange.query_every_s=0", "exchange.runs=4"})
          .tally);
  const double message_s = static_cast<double>(all.n_bits) / static_cast<double>(all.n_sent) / 600;
  EXPECT_GT(all.age().mean_s(), message_s + 0.5);
  EXPECT_LT(all.age().mean_s(), message_s + 2);
  EXPECT_GT(all.age().quantile_s(0.01), message_s);
}

TEST(SharedLinkSetup, OutOfReachNothingArrives) {
  const SharedLinkPoint point = only_point({"receiver.range_m=20"});
  for (const DirectionTally& direction : point.tally.direction) {
    EXPECT_GT(direction.n_sent, 5U);
    EXPECT_EQ(direction.n_accepted, 0U);
    EXPECT_EQ(direction.n_answered, 0U);
    EXPECT_GT(direction.n_timed_out, 0U);
    EXPECT_EQ(direction.age().unknown_share(), 1);
    EXPECT_GT(direction.n_bit_errors, direction.n_bits / 4) << "every light bit, at least";
  }
}

TEST(SharedLinkSetup, MeasuredEachHearsItselfOffTheFloor) {
  const DirectionTally real = together(only_point(patient).tally);
  EXPECT_GE(real.n_own + 2, real.n_sent) << "the floor gives back what the LED says";
  const DirectionTally shielded =
      together(only_point(with_keys(patient, {"exchange.own_reflection=false"})).tally);
  EXPECT_EQ(shielded.n_own, 0U);
  const DirectionTally black =
      together(only_point(with_keys(patient, {"floor.diffuse_reflectance=0"})).tally);
  EXPECT_EQ(black.n_own, 0U) << "a floor that scatters nothing gives nothing back";
}

std::uint64_t sum(const SharedLinkReasons& reasons) {
  return std::accumulate(reasons.begin(), reasons.end(), std::uint64_t{0});
}

// The AGC of a TSOP4856 cuts long messages, the own ones too, and at 60 m nothing else is heard.
TEST(SharedLinkSetup, OwnMessagesThatAreDamagedAreNotTheOthers) {
  const std::vector<std::string> deaf{"receiver.module=TSOP4856", "receiver.range_m=60"};
  const DirectionTally all = together(only_point(deaf).tally);
  EXPECT_EQ(all.n_accepted, 0U);
  EXPECT_GT(sum(all.own_damaged), all.n_sent / 4);
  EXPECT_EQ(sum(all.rejected), 0U);
}

// At 12.5 m two of a hundred bits are wrong, and the own reflection is clear.
TEST(SharedLinkSetup, MessagesOfTheOtherThatAreDamagedAreNotItsOwn) {
  const DirectionTally all = together(only_point({"receiver.range_m=12.5"}).tally);
  EXPECT_GT(sum(all.rejected), all.n_sent / 4);
  EXPECT_LT(sum(all.own_damaged), all.n_sent / 10);
}

TEST(SharedLinkSetup, LightIsThatOfALink) {
  const SharedLinkSetup setup = make_shared_link(point_scenario(loaded(nodes), {}));
  const Link link = link_of({"receiver.module=TSSP4056", "receiver.range_m=2"});
  EXPECT_DOUBLE_EQ(setup.irradiance_mw_per_m2, link.operating.irradiance_mw_per_m2);
  EXPECT_GT(setup.reflected_mw_per_m2, 0);
}

TEST(SharedLinkSetup, ThreadsAndTheNumberOfRunsChangeNothing) {
  const LoadedScenario scenario = loaded(nodes, {"exchange.runs=5", "exchange.duration_s=5"});
  const auto digest = [&](int threads) {
    return dataset_digest(
        dataset_of(scenario, "", shared_link_columns(),
                   counted_points(shared_link_measurement, scenario, {.threads = threads})));
  };
  const std::string one = digest(1);
  EXPECT_EQ(digest(2), one);
  EXPECT_EQ(digest(5), one);
  const SharedLinkSetup setup = make_shared_link(point_scenario(scenario, {}));
  SharedLinkTally single;
  for (std::uint32_t run = 0; run < 5; ++run) single += run_shared_link(setup, run, 1);
  const SharedLinkTally all = run_shared_link(setup, 0, 5);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(all.direction[i].n_sent, single.direction[i].n_sent);
    EXPECT_EQ(all.direction[i].n_bits, single.direction[i].n_bits);
    EXPECT_EQ(all.direction[i].n_bit_errors, single.direction[i].n_bit_errors);
    EXPECT_EQ(all.direction[i].age().mean_s(), single.direction[i].age().mean_s());
  }
}

TEST(SharedLinkSetup, CompressionSendsLessAndKnowsOlderValues) {
  const std::vector<std::string> still{"exchange.change_every_s=1e6", "exchange.query_every_s=0"};
  const DirectionTally all =
      together(only_point(with_keys(still, {"exchange.compressed=false"})).tally);
  const DirectionTally few =
      together(only_point(with_keys(still, {"exchange.compressed=true"})).tally);
  EXPECT_LT(few.n_bits, all.n_bits / 2);
  EXPECT_GT(few.age().mean_s(), all.age().mean_s());
  // A full set every 5 s at the earliest, then at the node's next turn: 2.5 to 3.5 s old on
  // average.
  EXPECT_NEAR(few.age().mean_s(), 3.2, 0.8);
}

TEST(SharedLinkSetup, AnInterruptKeepsWhatWasFinished) {
  const std::atomic<bool> stop{true};
  const LoadedScenario scenario = loaded(nodes);
  const auto points = counted_points(shared_link_measurement, scenario, {.interrupt = &stop});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].tally.n_runs, 0U);
  EXPECT_NO_THROW(dataset_of(scenario, "", shared_link_columns(), points));
}

TEST(SharedLinkSetup, RefusesWhatCannotBe) {
  EXPECT_NE(refusal(nodes, {"exchange.interval_min_ms=500", "exchange.interval_max_ms=400"})
                .find("the shortest pause cannot exceed the longest"),
            std::string::npos);
}

void expect_module_asked_for(const LoadedScenario& scenario) {
  try {
    check_experiment(scenario);
    ADD_FAILURE() << "accepted";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(failure.what()).find("use a module"), std::string::npos);
  }
}

TEST(SharedLinkSetup, RefusesAnIdealReceiverAtAnyPoint) {
  EXPECT_NO_THROW(check_experiment(loaded(nodes)));
  expect_module_asked_for(loaded(nodes, {"receiver.module=ideal-coherent"}));
  expect_module_asked_for(loaded(nodes, {"receiver.module=TSSP4056,ideal-coherent"}));
}

// What is lost to a collision is lost to both: as likely for each message, but in pairs.
TEST(SharedLinkSetup, RunsAreTheClustersOfWhatIsLost) {
  const SharedLinkPoint point = only_point({"receiver.range_m=12.5", "exchange.runs=5"});
  for (const DirectionTally& tally : point.tally.direction) {
    EXPECT_EQ(tally.losses.n, 5U);
    EXPECT_EQ(tally.losses.part, tally.n_sent - tally.n_accepted);
    EXPECT_EQ(tally.losses.whole, tally.n_sent);
  }
  EXPECT_EQ(point.tally.losses.n, 5U);
  const DirectionTally all = together(point.tally);
  EXPECT_EQ(all.losses, point.tally.losses);
  EXPECT_EQ(all.losses.part, all.n_sent - all.n_accepted);
  EXPECT_EQ(message_loss(all).high, clustered_ratio(point.tally.losses, 0.95).high);
}

const std::vector<double>& reals(const Dataset& data, const std::string& name) {
  const auto at = std::ranges::find(data.variables, name,
                                    [](const Dataset::Variable& v) { return v.facts.name; });
  return std::get<std::vector<double>>(at->values);
}

TEST(SharedLinkSetup, EachVariableHasAnAge) {
  const LoadedScenario scenario =
      loaded(nodes + "[sweep]\nexchange.variables = [1, 3]\n", {"exchange.query_every_s=0"});
  const auto points = counted_points(shared_link_measurement, scenario, {});
  const Dataset data = dataset_of(scenario, "", shared_link_columns(), points);
  for (const char* name : {"variable_age_mean_s", "variable_age_p95_s", "variable_unknown_share"}) {
    const auto& values = reals(data, name);
    ASSERT_EQ(values.size(), 12U) << "points, senders, variables";
    for (const std::size_t i : {0U, 3U, 6U, 7U, 8U, 9U, 10U, 11U}) EXPECT_GT(values[i], 0) << i;
    for (const std::size_t i : {1U, 2U, 4U, 5U}) EXPECT_TRUE(std::isnan(values[i])) << i;
  }
  const auto& mean = reals(data, "variable_age_mean_s");
  const auto& unknown = reals(data, "variable_unknown_share");
  EXPECT_EQ(mean[3], points[0].tally.direction[1].age().mean_s()) << "of one";
  double known = 0, sum = 0;
  for (const std::size_t i : {6U, 7U, 8U}) {
    known += 1 - unknown[i];
    sum += mean[i] * (1 - unknown[i]);
  }
  EXPECT_NEAR(sum / known, points[1].tally.direction[0].age().mean_s(), 1e-9);
}

// Both speak for more than half a minute behind the one second in which they may begin, and each
// would hear itself without the jammer.
TEST(SharedLinkSetup, OtherLightsDoNotEndBeforeTheLastTurn) {
  const std::vector<std::string> jammed{
      "exchange.duration_s=1",           "exchange.variables=50",
      "exchange.value_characters=40",    "exchange.runs=1",
      "disturbance.jammer.kind=carrier", "disturbance.jammer.irradiance_w_per_m2=1"};
  const DirectionTally all = together(only_point(jammed).tally);
  EXPECT_GT(all.n_bits, 30000U);
  EXPECT_EQ(all.n_own, 0U);
  EXPECT_EQ(sum(all.own_damaged), 0U);
}

// "[:BA|RA1|D0|C00]", "[:BA|QB1|C00]" and "[:BA|N0|D0|C00]" with their line ends: 18, 15 and 17.
TEST(SharedLinkSetup, LongestTurnAnswersAsksAndTellsAll) {
  const SharedLinkSetup setup = make_shared_link(
      point_scenario(loaded(nodes, {"exchange.variables=1", "exchange.value_characters=1"}), {}));
  EXPECT_NEAR(longest_turn(setup).value, 50 * 10 / 600.0, 1e-9);
}

double reflection(const std::vector<std::string>& set) {
  return make_shared_link(point_scenario(loaded(nodes, set), {})).reflected_mw_per_m2;
}

TEST(SharedLinkSetup, ReflectionTurnsWithLedAndModule) {
  const double straight = reflection({});
  EXPECT_LT(reflection({"led.yaw_deg=180"}), 0.1 * straight) << "the module looks the other way";
  EXPECT_LT(reflection({"receiver.yaw_deg=180"}), 0.1 * straight);
  EXPECT_NEAR(reflection({"led.yaw_deg=180", "receiver.yaw_deg=180"}), straight, 1e-6 * straight)
      << "the same, turned round";
  EXPECT_NEAR(reflection({"led.yaw_deg=30", "receiver.bearing_deg=30"}), straight, 1e-9 * straight)
      << "the LED looks at the other";
  EXPECT_NEAR(reflection({"receiver.bearing_deg=40"}), reflection({"led.yaw_deg=-40"}),
              1e-9 * straight)
      << "40 degrees beside the other";
}

}  // namespace
}  // namespace sim
