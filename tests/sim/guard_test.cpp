// The robo-guard as a whole: an arena, a relay behind it, and a waterfall whose stages add up.
#include <atomic>
#include <string>

#include "counted_points.hpp"
#include "gtest/gtest.h"
#include "sim/columns/columns_dataset.hpp"
#include "sim/guard/guard_experiment.hpp"
#include "sim/guard/guard_report.hpp"
#include "tests/sim/scenarios.hpp"

namespace sim {
namespace {

const std::string room = R"(
experiment = "guard"
[path]
x_m = [0, 2]
y_m = 0
[receiver]
module = "TSOP4156"
[arena]
runs = 3
[devices.near]
x_m = 2.5
yaw_deg = 180
messages = ["NEAR A", "NEAR B"]
source = "status"
status_hold_s = 2
[devices.far]
x_m = 4
y_m = 0.3
yaw_deg = 180
messages = "FAR"
source = "counter"
silent_every_s = 2
silent_for_s = 1
[guard]
byte_error_ratio = 0.005
)";

std::uint64_t count_of(const Dataset& data, const std::string& name) {
  for (const auto& variable : data.variables)
    if (variable.facts.name == name) {
      std::uint64_t sum = 0;
      for (const std::int64_t n : std::get<std::vector<std::int64_t>>(variable.values))
        sum += static_cast<std::uint64_t>(n);
      return sum;
    }
  ADD_FAILURE() << "no " << name;
  return 0;
}

TEST(Guard, TheStagesOfTheWaterfallAddUp) {
  const LoadedScenario scenario = loaded(room);
  const auto points = counted_points(guard_measurement, scenario, {});
  const Dataset data = dataset_of(scenario, "", guard_columns(), points);
  std::uint64_t sum = count_of(data, "n_known");
  for (const char* stage : {"n_silent", "n_out_of_reach", "n_agc", "n_collision", "n_uart",
                            "n_checksum", "n_replaced", "n_sharedlink_lost"})
    sum += count_of(data, stage);
  EXPECT_EQ(sum, count_of(data, "n_messages"));
  EXPECT_EQ(count_of(data, "n_delivered"), count_of(data, "n_known") +
                                               count_of(data, "n_replaced") +
                                               count_of(data, "n_sharedlink_lost"));
  EXPECT_GT(count_of(data, "n_known"), 10U);
  EXPECT_GT(count_of(data, "n_silent"), 0U);
  EXPECT_GT(count_of(data, "n_collision"), 0U);
}

TEST(Guard, ThreadsChangeNothing) {
  const LoadedScenario scenario = loaded(room);
  const auto digest = [&](int threads) {
    return dataset_digest(
        dataset_of(scenario, "", guard_columns(),
                   counted_points(guard_measurement, scenario, {.threads = threads})));
  };
  const std::string one = digest(1);
  EXPECT_EQ(digest(2), one);
  EXPECT_EQ(digest(5), one);
}

TEST(Guard, ItsArenaIsThatOfAnArena) {
  const auto guards = counted_points(guard_measurement, loaded(room), {});
  // The point differs in nothing but [guard], of which an arena knows nothing; so it is read from
  // the same scenario.
  const auto arenas = counted_points(arena_measurement, loaded(room), {});
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(guards[0].tally.senders[i].by_cause, arenas[0].tally.senders[i].by_cause);
}

TEST(Guard, WhateverTheLineDoesTheGuardHearsTheSame) {
  const auto points =
      counted_points(guard_measurement, loaded(room, {"guard.byte_error_ratio=0,0.1"}), {});
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(points[0].tally.senders[i].by_cause, points[1].tally.senders[i].by_cause);
}

TEST(Guard, AWorseLineLosesMoreAndOnlyThere) {
  const LoadedScenario scenario = loaded(room, {"guard.byte_error_ratio=0,0.3", "arena.runs=2"});
  const auto points = counted_points(guard_measurement, scenario, {});
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(relayed_together(points[0]).n_lost, 0U);
  EXPECT_GT(relayed_together(points[1]).n_lost, 5U);
  EXPECT_GT(points[1].relayed.n_timed_out, points[0].relayed.n_timed_out);
}

TEST(Guard, EachRunHasALineOfItsOwn) {  // out or not all through a run, as likely as not
  const auto points =
      counted_points(guard_measurement,
                     loaded(room, {"guard.outage_every_s=1e5", "guard.outage_for_s=1e5",
                                   "guard.byte_error_ratio=0", "arena.runs=8"}),
                     {});
  EXPECT_GT(relayed_together(points[0]).n_known, 0U);
  EXPECT_GT(relayed_together(points[0]).n_lost, 0U);
}

TEST(Guard, AnInterruptLeavesPointsWithoutRuns) {
  const std::atomic<bool> stop{true};
  const LoadedScenario scenario = loaded(room);
  const auto points = counted_points(guard_measurement, scenario, {.interrupt = &stop});
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].tally.n_runs, 0U);
  EXPECT_NO_THROW(dataset_of(scenario, "", guard_columns(), points));
}

std::string list_refusal(const std::string& devices) {
  try {
    counted_points(guard_measurement,
                   loaded("experiment = \"guard\"\n[arena]\nruns = 1\nduration_s = 1\n" + devices),
                   {});
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "accepted";
}

TEST(Guard, RefusesMessagesThatCannotBeAList) {
  EXPECT_EQ(
      list_refusal("[devices.a]\nx_m = 1\nmessages = \"X 1\"\n[devices.b]\nx_m = 2\nmessages = "
                   "\"X 2\"\n"),
      "devices.b.messages = \"X 2\" (another device's messages begin with this word too) "
      "give each a word of its own; {} is its number");
  EXPECT_EQ(list_refusal("[devices.a]\nx_m = 1\nmessages = [\"X 1\", \"Y 1\"]\n"),
            "devices.a.messages = \"Y 1\" (its first word is the name by which the guard knows "
            "it) begin all messages of a device with one word");
  EXPECT_NE(
      list_refusal("[devices.a]\nx_m = 1\nmessages = \"X [1]\"\n").find("SharedLink cannot carry"),
      std::string::npos);
  EXPECT_NE(list_refusal("[devices.a]\nx_m = 1\nmessages = \"X " + std::string(240, 'y') + "\"\n")
                .find("no value of a shared list"),
            std::string::npos);
}

}  // namespace
}  // namespace sim
