// What holds in any arena: losses add up, and results hang neither on threads nor on neighbours.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include "arena_scenes.hpp"
#include "counted_points.hpp"
#include "gtest/gtest.h"
#include "sim/arena/arena_columns.hpp"
#include "sim/arena/trajectory.hpp"
#include "sim/columns/columns_dataset.hpp"
#include "sim/command/experiments.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

/// Moving receiver, random places and silent spells; some overlap, some are far.
const std::string busy =
    "[arena]\nruns = 6\n[path]\nx_m = [0, 4, 4]\ny_m = [0, 0, 2]\nspeed_m_per_s = 0.8\n"
    "[devices.crowd]\ncount = 5\nx_m = 3\ny_m = 1\nspread_x_m = 4\nspread_y_m = 3\n"
    "yaw_spread_deg = 360\nmessages = \"NO {}\"\nsilent_every_s = 4\nsilent_for_s = 2\n"
    "carrier_spread_ppm = 2000\nclock_spread_ppm = 2000\n"
    "[devices.far]\nx_m = 200\n"
    "[devices.list]\nx_m = 5\nyaw_deg = 180\nsource = \"list\"\nmessages = [\"A\", \"BC\"]\n";

std::string json_of(const std::vector<std::string>& set, int threads) {
  const LoadedScenario scenario = loaded_arena(busy, set);
  return dataset_json(
      dataset_of(scenario, "", arena_columns(),
                 counted_points(arena_measurement, scenario, {.threads = threads})));
}

TEST(ArenaLaws, FatesAddUp) {
  const ArenaPoint point = arena_point(busy, {"receiver.module=TSOP4856"});
  ASSERT_EQ(point.tally.senders.size(), 7u);
  std::uint64_t delivered = 0;
  for (const SenderTally& tally : point.tally.senders) {
    EXPECT_GT(tally.messages(), 0u);
    EXPECT_EQ(tally.sent(), tally.messages() - tally[LossCause::silent]);
    EXPECT_EQ(tally.lost() + tally[LossCause::delivered], tally.sent());
    EXPECT_LE(tally.n_in_reach, tally.sent());
    EXPECT_LE(tally.n_overlapped, tally.n_in_reach);
    EXPECT_LE(tally.n_captured, tally.n_overlapped);
    EXPECT_LE(tally.n_captured, tally[LossCause::delivered]);
    EXPECT_EQ(tally[LossCause::out_of_reach], tally.sent() - tally.n_in_reach);
    EXPECT_LE(tally[LossCause::collision], tally.n_overlapped - tally.n_captured);
    EXPECT_LE(tally.airtime_in_reach_us, tally.airtime_us);
    EXPECT_LE(tally.airtime_delivered_us, tally.airtime_us);
    EXPECT_LE(tally.latency.n_runs_heard, 6u);
    EXPECT_LE(tally.latency.sum_us, tally.latency.n_runs_heard * tally.latency.worst_us);
    EXPECT_EQ(tally.latency.n_runs_heard > 0, tally[LossCause::delivered] > 0);
    delivered += tally[LossCause::delivered];
  }
  EXPECT_EQ(point.tally.n_runs, 6u);
  EXPECT_EQ(delivered, point.heard.size());
  EXPECT_EQ(together(point)[LossCause::delivered], delivered);
  for (const LossCause cause : {LossCause::delivered, LossCause::silent, LossCause::out_of_reach,
                                LossCause::agc, LossCause::collision})
    EXPECT_GT(together(point)[cause], 0u) << static_cast<int>(cause);
}

TEST(ArenaLaws, WhatIsHeardIsInOrderAndOnTheWay) {
  const LoadedScenario scenario = loaded_arena(busy);
  const ArenaPoint point = counted_points(arena_measurement, scenario, {.threads = 2}).front();
  const Trajectory way(scenario.base.path);
  ASSERT_GT(point.heard.size(), 30u);
  std::vector<std::uint64_t> first_us(point.senders.size());
  for (std::size_t i = 0; i < point.heard.size(); ++i) {
    const HeardFrame& heard = point.heard[i];
    const Pose2D place = way.at(dsp::Seconds(heard.end_s));
    EXPECT_EQ(heard.x_m, place.x);
    EXPECT_EQ(heard.y_m, place.y);
    EXPECT_GE(heard.start_s, 0);
    EXPECT_LT(heard.start_s, point.duration_s);
    if (i == 0) continue;
    const HeardFrame& before = point.heard[i - 1];
    EXPECT_TRUE(before.run < heard.run || before.end_s <= heard.end_s) << i;
  }
  Latency any;
  for (std::uint32_t run = 0; run < 6; ++run) {
    const auto first = std::ranges::find(point.heard, run, &HeardFrame::run);
    if (first != point.heard.end()) any.add(dsp::Seconds(first->end_s));
  }
  EXPECT_EQ(point.tally.any.n_runs_heard, any.n_runs_heard);
  EXPECT_EQ(point.tally.any.sum_us, any.sum_us);
  EXPECT_EQ(point.tally.any.worst_us, any.worst_us);
  std::vector<std::vector<bool>> met(6, std::vector<bool>(point.senders.size()));
  for (const HeardFrame& heard : point.heard) {
    if (met[heard.run][heard.sender]) continue;
    met[heard.run][heard.sender] = true;
    first_us[heard.sender] += static_cast<std::uint64_t>(std::llround(heard.end_s * 1e6));
  }
  for (std::size_t i = 0; i < first_us.size(); ++i)
    EXPECT_EQ(first_us[i], point.tally.senders[i].latency.sum_us) << i;
}

// Two devices of equal pauses meet in a whole run or never: the interval must say how few runs say
// anything.
TEST(ArenaLaws, RunsNotMessagesAreWhatAnIntervalCountsOn) {
  std::vector<Estimate> seeds;
  for (const char* seed : {"1", "2", "3"}) {
    const std::string fixed = "interval_min_ms = 500\ninterval_max_ms = 500";
    const ArenaPoint point =
        arena_point("[arena]\nruns = 8\nduration_s = 20\n" + device("a", "2", fixed) +
                        "[devices.b]\nx_m = 2\ny_m = 0.3\nyaw_deg = 180\n" + fixed + "\n",
                    {std::string("simulation.seed=") + seed});
    seeds.push_back(frame_loss(together(point)));
    EXPECT_GT(seeds.back().high - seeds.back().low, 0.3) << seed;
  }
  for (const Estimate& one : seeds)
    for (const Estimate& other : seeds) EXPECT_LT(one.low, other.high);
}

// A receiver that backs away at 3 m/s loses a lone device where a link does, from 12.2 m on.
TEST(ArenaLaws, ADeviceIsHeardAsFarAsItsLightGoes) {
  const ArenaPoint point = arena_point(
      "[arena]\nruns = 16\n[path]\nx_m = [0, -29]\nheading_deg = 0\nspeed_m_per_s = 3\n" +
      device("a", "1", "interval_min_ms = 0\ninterval_max_ms = 0"));
  const SenderTally& tally = point.tally.senders.front();
  double farthest = 0;
  for (const HeardFrame& heard : point.heard) farthest = std::max(farthest, 1 - heard.x_m);
  EXPECT_GT(farthest, 11);
  EXPECT_LT(farthest, 13);
  const double share_near = 11.2 / 29;  // of the way, of equal messages
  EXPECT_NEAR(
      static_cast<double>(tally[LossCause::delivered]) / static_cast<double>(tally.messages()),
      share_near, 0.04);
  EXPECT_GT(tally[LossCause::out_of_reach], tally.messages() / 2);
}

// With a slow AGC, which makes two passes of each run.
TEST(ArenaDeterminism, AnyNumberOfThreadsGivesTheSame) {
  const std::string one = json_of({"receiver.module=TSOP4856"}, 1);
  for (const int threads : {2, 5})
    EXPECT_TRUE(json_of({"receiver.module=TSOP4856"}, threads) == one) << threads;
}

TEST(ArenaDeterminism, MeasuredTheFirstRunsOfMoreAreTheSameRuns) {
  const ArenaPoint few = arena_point(busy, {"arena.runs=3"}), more = arena_point(busy);
  std::size_t in_few = 0;
  for (const HeardFrame& heard : more.heard) in_few += heard.run < 3;
  ASSERT_EQ(few.heard.size(), in_few);
  for (std::size_t i = 0; i < in_few; ++i) {
    EXPECT_EQ(few.heard[i].start_s, more.heard[i].start_s);
    EXPECT_EQ(few.heard[i].message, more.heard[i].message);
    EXPECT_EQ(few.heard[i].run, more.heard[i].run);
  }
}

TEST(ArenaDeterminism, MeasuredSeedsAndRunsDiffer) {
  EXPECT_FALSE(json_of({"simulation.seed=2"}, 2) == json_of({}, 2));
  const ArenaPoint point = arena_point(busy);
  std::set<double> starts;
  for (const HeardFrame& heard : point.heard) starts.insert(heard.start_s);
  EXPECT_EQ(starts.size(), point.heard.size());
}

/// When each device of that kind sends what, in one run of a scene without noise.
std::vector<std::string> heard_of(const ArenaPoint& point, const std::string& kind) {
  std::vector<std::string> lines;
  for (const HeardFrame& heard : point.heard)
    if (point.senders[heard.sender].kind == kind)
      lines.push_back(std::to_string(heard.run) + " " + point.senders[heard.sender].name + " " +
                      std::to_string(heard.start_s) + " " + heard.message);
  return lines;
}

// One more, by a name that comes first, too far to be heard at all; and one more of a kind.
TEST(ArenaDeterminism, ANewDeviceLeavesTheOthersAsTheyWere) {
  const std::string runs = "[arena]\nduration_s = 20\nruns = 2\n";
  const std::string old =
      runs +
      device("m", "2", "silent_every_s = 3\nsource = \"status\"\nmessages = [\"A\", \"B\"]") +
      device("z", "2", "count = 2\nspread_y_m = 1\nmessages = \"Z {}\"");
  const auto before = make_senders(loaded_arena(old).base);
  const auto after =
      make_senders(loaded_arena(old + device("a", "1000"), {"devices.z.count=3"}).base);
  ASSERT_EQ(after.size(), before.size() + 2);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i + 1].name, before[i].name);
    EXPECT_EQ(after[i + 1].point, before[i].point);
    EXPECT_EQ(after[i + 1].y_m, before[i].y_m);
  }
  const ArenaPoint alone = arena_point(old, {"noise.scale=0"});
  const ArenaPoint with = arena_point(old + device("a", "1000"), {"noise.scale=0"});
  for (const char* kind : {"m", "z"}) {
    EXPECT_FALSE(heard_of(alone, kind).empty());
    EXPECT_EQ(heard_of(with, kind), heard_of(alone, kind));
  }
}

TEST(ArenaDeterminism, NoTwoDevicesSendAlike) {
  const auto senders = make_senders(
      loaded_arena(device("a", "1", "count = 200") + device("b", "1", "count = 200")).base);
  std::set<std::uint32_t> points;
  for (const Sender& sender : senders) points.insert(sender.point);
  EXPECT_EQ(points.size(), 400u);
}

// The text of a result is the scenario, wherever it is read.
TEST(ArenaRepeats, ItsTextGivesTheSameDigest) {
  const LoadedScenario here = loaded_arena(
      busy, {"devices.far.led=TSAL6400", "arena.runs=2", "path.x_m=0,4", "path.y_m=0"});
  const LoadedScenario there = parse_scenario(here.text, "nowhere/y.toml", {}, {});
  check_experiment(there);
  const auto digest = [](const LoadedScenario& s) {
    return dataset_digest(
        dataset_of(s, "", arena_columns(), counted_points(arena_measurement, s, {.threads = 2})));
  };
  EXPECT_EQ(digest(there), digest(here));
}

// Those after the interrupt are none; what was finished before stays.
TEST(ArenaInterrupt, LeavesAWholeResult) {
  const LoadedScenario scenario = loaded_arena(
      "[arena]\nduration_s = 2\nruns = 2\n[devices.a]\nx_m = 1\nyaw_deg = 180\n"
      "[sweep]\ndevices.a.current_ma = [100, 50, 20]\n");
  std::atomic<bool> stop = false;
  const auto points = counted_points(arena_measurement, scenario, {.interrupt = &stop},
                                     [&](const ArenaPoint&) { stop = true; });
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[0].tally.n_runs, 2u);
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(points[i].tally.n_runs, 0u);
    EXPECT_EQ(points[i].coordinates, point_coordinates(scenario.sweep, i));
  }
  EXPECT_NE(dataset_json(dataset_of(scenario, "", arena_columns(), points)).find("\"n_runs\""),
            std::string::npos);
}

// Light along a way of 50000 s takes hours to work out.
TEST(ArenaInterrupt, IsHeardWhileLightIsWorkedOut) {
  const LoadedScenario slow = loaded_arena(
      "[path]\nx_m = [0, 900]\nspeed_m_per_s = 0.02\n[devices.a]\nx_m = 1\nleds = 8\n");
  std::atomic<bool> stop = false;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stop = true;
  });
  EXPECT_EQ(counted_points(arena_measurement, slow, {.threads = 2, .interrupt = &stop})
                .front()
                .tally.n_runs,
            0u);
}

// Whenever it comes: what is left are the first runs.
TEST(ArenaInterrupt, KeepsTheRunsThatWereFinished) {
  const std::string scene = "[arena]\nduration_s = 0.5\nruns = 100000\n" + device("a", "1");
  std::atomic<bool> stop = false;
  std::jthread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    stop = true;
  });
  const ArenaPoint left =
      counted_points(arena_measurement, loaded_arena(scene), {.threads = 2, .interrupt = &stop})
          .front();
  EXPECT_LT(left.tally.n_runs, 100000u);
  if (left.tally.n_runs == 0) return;
  const ArenaPoint same = arena_point(scene, {"arena.runs=" + std::to_string(left.tally.n_runs)});
  ASSERT_EQ(left.heard.size(), same.heard.size());
  EXPECT_EQ(left.tally.senders.front().by_cause, same.tally.senders.front().by_cause);
  EXPECT_EQ(left.heard.back().run, same.heard.back().run);
}

}  // namespace
}  // namespace sim
