// Runs of any experiment: in parts, kept as bytes and taken up again, they are the runs at once.
#include "sim/engine/run_counting.hpp"

#include <atomic>
#include <cmath>
#include <random>
#include <thread>

#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/arena/arena_columns.hpp"
#include "sim/columns/columns_dataset.hpp"
#include "sim/false_accepts/false_accept_report.hpp"
#include "sim/guard/guard_report.hpp"
#include "sim/location/accuracy_report.hpp"
#include "sim/location/presence_report.hpp"
#include "sim/shared_link/shared_link_report.hpp"
#include "small_experiments.hpp"

namespace sim {
namespace {

LoadedScenario small_scenario(const std::string& name, const std::string& amount) {
  for (const test::Experiment& experiment : test::small_experiments)
    if (experiment.name == name) return loaded(test::scenario_of(experiment, true), {amount});
  ADD_FAILURE() << "no experiment " << name;
  return {};
}

/// All that is known of the points, with what follows from lists and sums.
template <class Setup, class Tally, class Point>
std::string json_of(const RunCounting<Setup, Tally, Point>& counting,
                    const LoadedScenario& scenario, const Columns<Point>& columns) {
  return dataset_json(dataset_of(scenario, "", columns, counting.points()));
}

/// Counts one shard and keeps it.
template <class Setup, class Tally, class Point>
std::string counted_shard(const Measurement<Setup, Tally, Point>& kind,
                          const LoadedScenario& scenario, const Shard& shard, int threads) {
  RunCounting<Setup, Tally, Point> counting(kind, scenario, {shard});
  for (std::size_t i = 0; i < counting.points().size(); ++i)
    counting.count(i, {{.threads = threads}});
  return counting.checkpoint();
}

template <class Setup, class Tally, class Point>
void expect_parts_to_add_up(const Measurement<Setup, Tally, Point>& kind,
                            const LoadedScenario& scenario, const Columns<Point>& columns) {
  RunCounting<Setup, Tally, Point> whole(kind, scenario);
  RunCounting<Setup, Tally, Point> sum(kind, scenario, {{1, 3}, {2, 3}, {3, 3}});
  for (std::size_t i = 0; i < whole.points().size(); ++i) whole.count(i, {{.threads = 3}});
  for (const Shard& shard : {Shard{3, 3}, Shard{1, 3}, Shard{2, 3}})
    sum.add(counted_shard(kind, scenario, shard, static_cast<int>(shard.number)));
  EXPECT_NE(json_of(sum, scenario, columns), json_of(whole, scenario, columns));
  sum.describe_all({});
  EXPECT_EQ(json_of(sum, scenario, columns), json_of(whole, scenario, columns));
}

/// Bytes of a checkpoint are changed at random: it is refused, or what it then says is described.
/// What is left of one that was cut off is refused.
template <class Setup, class Tally, class Point>
void expect_damage_to_be_met(const Measurement<Setup, Tally, Point>& kind,
                             const LoadedScenario& scenario, const Columns<Point>& columns) {
  const std::string whole = counted_shard(kind, scenario, {}, 2);
  std::mt19937_64 random(1);
  for (int i = 0; i < 2; ++i) {
    std::string damaged = whole;
    for (int bytes = 0; bytes < 3; ++bytes)
      damaged[random() % damaged.size()] = static_cast<char>(random());
    RunCounting<Setup, Tally, Point> counting(kind, scenario);
    try {
      counting.add(damaged);
      counting.describe_all({});
      dataset_json(dataset_of(scenario, "", columns, counting.points()));
    } catch (const std::exception&) {  // it is refused
    }
  }
  RunCounting<Setup, Tally, Point> counting(kind, scenario);
  EXPECT_THROW(counting.add(whole.substr(0, random() % whole.size())), Failure);
}

/// Each experiment with its scenario and columns.
template <class Check>
void for_each_experiment(const Check& check) {
  check(arena_measurement, small_scenario("arena", "arena.runs=3"), arena_columns());
  check(guard_measurement, small_scenario("guard", "arena.runs=3"), guard_columns());
  check(shared_link_measurement, small_scenario("sharedlink", "exchange.runs=3"),
        shared_link_columns());
  check(presence_measurement, small_scenario("presence", "presence.trials=12"), presence_columns());
  check(location_measurement, small_scenario("location", "location.trials=8"), location_columns());
  check(false_accept_measurement, small_scenario("listening", "listening.runs=3"),
        false_accept_columns());
}

TEST(RunParts, AddUpInAnyOrder) {
  for_each_experiment([](const auto& kind, const LoadedScenario& scenario, const auto& columns) {
    SCOPED_TRACE(scenario.base.experiment);
    expect_parts_to_add_up(kind, scenario, columns);
  });
}

TEST(CheckpointBytes, DamageIsMet) {
  for_each_experiment([](const auto& kind, const LoadedScenario& scenario, const auto& columns) {
    SCOPED_TRACE(scenario.base.experiment);
    expect_damage_to_be_met(kind, scenario, columns);
  });
}

// ---- interrupts, on an experiment that counts its runs and lists them ----

struct NumberedRuns {
  std::vector<std::uint32_t> runs{};

  NumberedRuns& operator+=(const NumberedRuns& next) {
    runs.insert(runs.end(), next.runs.begin(), next.runs.end());
    return *this;
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(runs);
  }
};

struct NumberedPoint {
  std::vector<std::uint32_t> runs{};
  StopReason stop = StopReason::interrupted;
  bool reached() const { return !runs.empty(); }
};

constexpr std::uint32_t all_runs = 20;

/// Runs from this on take until they are over.
std::atomic<std::uint32_t> held_from = 0;

/// As long as this lives.
struct HeldRuns {
  explicit HeldRuns(std::uint32_t from) { held_from = from; }
  HeldRuns(const HeldRuns&) = delete;
  HeldRuns& operator=(const HeldRuns&) = delete;
  ~HeldRuns() { held_from = 0; }
};

NumberedRuns run_numbered(const int&, std::uint32_t first, int n, const std::atomic<bool>* over) {
  while (held_from > 0 && first >= held_from && !is_stopped(over)) std::this_thread::yield();
  NumberedRuns numbers;
  for (int i = 0; i < n; ++i) numbers.runs.push_back(first + static_cast<std::uint32_t>(i));
  return numbers;
}

const Measurement<int, NumberedRuns, NumberedPoint> numbered_measurement{
    .unreached = [](const Scenario&, const SourceLocations&,
                    const std::vector<double>&) { return NumberedPoint{}; },
    .prepare = [](const Scenario&, const SourceLocations&, const Workers&) { return 0; },
    .most_at_once = [](const int&, std::uint32_t, int) { return 3U; },
    .run = run_numbered,
    .ratio =
        [](const int&, const NumberedRuns& numbers, double) {
          const double half_width = 1 / std::sqrt(static_cast<double>(numbers.runs.size()));
          return Estimate{1, 1 - half_width, 1 + half_width};
        },
    .describe = [](NumberedPoint& point, const int&,
                   const NumberedRuns& n) { point.runs = n.runs; }};

using NumberedCounting = RunCounting<int, NumberedRuns, NumberedPoint>;

std::vector<std::uint32_t> first_numbers(std::uint32_t n) {
  return run_numbered(0, 0, static_cast<int>(n), nullptr).runs;
}

/// Counts so many runs, whole batches, until an interrupt.
void count_first(NumberedCounting& counting, std::uint32_t n) {
  const HeldRuns held(n);
  std::atomic<bool> stop = false;
  counting.count(0, {{.threads = 1, .interrupt = &stop}},
                 [&](std::uint32_t done, std::uint32_t) { stop = done == n; });
}

TEST(RunCounting, GoesOnBehindTheRunsThatItHas) {
  const LoadedScenario scenario = loaded("experiment = \"presence\"\n", {"presence.trials=20"});
  NumberedCounting begun(numbered_measurement, scenario);
  count_first(begun, 9);
  EXPECT_EQ(begun.points()[0].runs, first_numbers(9));
  const auto before = begun.points()[0].runs;
  NumberedCounting again(numbered_measurement, scenario);
  again.add(begun.checkpoint());
  again.describe_all({});
  EXPECT_EQ(again.points()[0].runs, before);
  again.count(0, {{.threads = 2}});
  EXPECT_EQ(again.points()[0].runs, first_numbers(all_runs));
}

TEST(RunCounting, AnInterruptBeforeAllLeavesWhatIsThereAsItIs) {
  const LoadedScenario scenario = loaded("experiment = \"presence\"\n", {"presence.trials=20"});
  const std::atomic<bool> stop = true;
  NumberedCounting nothing(numbered_measurement, scenario);
  nothing.count(0, {{.interrupt = &stop}});
  EXPECT_FALSE(nothing.points()[0].reached());
  NumberedCounting half(numbered_measurement, scenario, {{1, 2}});
  half.add(counted_shard(numbered_measurement, scenario, {1, 2}, 1));
  half.describe_all({});
  half.count(0, {{.interrupt = &stop}});
  EXPECT_EQ(half.points()[0].runs, first_numbers(all_runs / 2));
  EXPECT_EQ(half.checkpoint(), counted_shard(numbered_measurement, scenario, {1, 2}, 1));
}

TEST(RunCounting, SaysHowManyPointsAreFinished) {
  const LoadedScenario scenario =
      loaded("experiment = \"presence\"\n[sweep]\npresence.trials = [4, 20, 21]\n");
  NumberedCounting all(numbered_measurement, scenario),
      half(numbered_measurement, scenario, {{1, 2}});
  EXPECT_EQ(all.n_begun(), 0U);
  for (NumberedCounting* counting : {&all, &half}) {
    counting->count(0, {});
    counting->count(2, {});
    EXPECT_EQ(counting->n_begun(), 2U);
    EXPECT_EQ(counting->n_finished(), 2U);
  }
  NumberedCounting sum(numbered_measurement, scenario, {{1, 2}, {2, 2}});
  sum.add(half.checkpoint());
  EXPECT_EQ(sum.n_begun(), 2U);
  EXPECT_EQ(sum.n_finished(), 0U) << "the other half is missing";
}

TEST(RunCounting, RefusesWhatIsNoCheckpointOfIt) {
  const LoadedScenario scenario = loaded("experiment = \"presence\"\npresence.trials = 20\n");
  const LoadedScenario shorter = loaded("experiment = \"presence\"\npresence.trials = 19\n");
  const LoadedScenario swept =
      loaded("experiment = \"presence\"\n[sweep]\npresence.trials = [20, 21]\n");
  const std::string whole = counted_shard(numbered_measurement, scenario, {}, 1);
  for (const std::string& wrong :
       {std::string(), whole.substr(0, whole.size() / 2), std::string(100, '\xff'),
        counted_shard(numbered_measurement, swept, {}, 1)})
    EXPECT_THROW(NumberedCounting(numbered_measurement, scenario).add(wrong), Failure);
  EXPECT_THROW(NumberedCounting(numbered_measurement, shorter).add(whole), Failure);
  NumberedCounting(numbered_measurement, scenario).add(whole);
}

TEST(RunCounting, IsBroughtUpToDateWhileItGoesOn) {
  const LoadedScenario scenario = loaded("experiment = \"presence\"\n", {"presence.trials=20"});
  NumberedCounting counting(numbered_measurement, scenario);
  const HeldRuns held(9);
  std::atomic<bool> stop = false;
  std::vector<std::uint32_t> seen;
  counting.count(0, {{.threads = 1, .interrupt = &stop}},
                 [&](std::uint32_t done, std::uint32_t all) {
                   EXPECT_EQ(all, all_runs);
                   counting.describe_current();
                   EXPECT_EQ(counting.points()[0].runs, first_numbers(done));
                   stop = done == 9;
                 });
  EXPECT_EQ(counting.points()[0].runs, first_numbers(9));
}

// ---- stop rules: the interval of numbered runs is 1 +- 1/sqrt(n) ----

LoadedScenario presence(const std::string& trials, const std::string& rule) {
  return loaded("experiment = \"presence\"\n", {"presence.trials=" + trials, rule});
}

TEST(RunCounting, StopsAtTheFirstLookThatFindsTheIntervalNarrow) {
  for (const auto& [width, n] : {std::pair{"0.2", 32U},
                                 {"0.25", 16U},
                                 {"0.0501", 400U},
                                 {"0.01", 10240U},
                                 {"0.001", 12000U}})
    for (const int threads : {1, 2, 5}) {
      const LoadedScenario scenario = presence("12000", std::string("stop.rel_ci=") + width);
      NumberedCounting counting(numbered_measurement, scenario);
      counting.count(0, {{.threads = threads}});
      EXPECT_EQ(counting.points()[0].runs, first_numbers(n)) << width << ", " << threads;
      EXPECT_EQ(counting.points()[0].stop,
                n == 12000 ? StopReason::max_frames : StopReason::rel_ci);
      EXPECT_EQ(counting.n_finished(), 1U);
    }
}

TEST(RunCounting, StopsThereAfterAnInterruptToo) {
  const LoadedScenario scenario = presence("1000", "stop.rel_ci=0.2");
  for (const std::uint32_t before : {3U, 9U, 24U, 30U}) {
    NumberedCounting begun(numbered_measurement, scenario);
    count_first(begun, before);
    EXPECT_EQ(begun.points()[0].runs, first_numbers(before));
    EXPECT_EQ(begun.n_finished(), 0U);
    NumberedCounting again(numbered_measurement, scenario);
    again.add(begun.checkpoint());
    again.count(0, {{.threads = 2}});
    EXPECT_EQ(again.points()[0].runs, first_numbers(32)) << before;
  }
}

TEST(RunCounting, RunsNothingBehindTheStop) {
  const LoadedScenario scenario = presence("1000", "stop.rel_ci=0.2");
  const std::string whole = counted_shard(numbered_measurement, scenario, {}, 2);
  NumberedCounting again(numbered_measurement, scenario);
  again.add(whole);
  EXPECT_EQ(again.n_finished(), 1U);
  again.count(0, {{.threads = 2}});
  again.describe_all({});
  EXPECT_EQ(again.points()[0].runs, first_numbers(32));
  EXPECT_EQ(again.checkpoint(), whole);
}

TEST(RunCounting, StopsWhereALevelIsSurelyLeft) {
  const auto runs_with = [](const std::string& target) {
    const LoadedScenario scenario = loaded(test::scenario_of(test::small_experiments[0], false),
                                           {"arena.runs=1000", "stop.target_flr=" + target});
    NumberedCounting counting(numbered_measurement, scenario);
    counting.count(0, {{.threads = 2}});
    return counting.points()[0].runs.size();
  };
  EXPECT_EQ(runs_with("0.5"), 8U);   // 1 - 1/sqrt(8) = 0.65
  EXPECT_EQ(runs_with("0.8"), 32U);  // 1 - 1/sqrt(32) = 0.82, of 24 runs 0.796
  EXPECT_EQ(runs_with("0.99"), 1000U);
}

TEST(CheckpointBytes, AListThatIsLongerThanTheBytesIsRefused) {
  const std::string bytes = bytes_of(std::vector<std::uint64_t>{1, 2, 3});
  EXPECT_EQ(from_bytes<std::vector<std::uint64_t>>(bytes), (std::vector<std::uint64_t>{1, 2, 3}));
  EXPECT_TRUE(
      from_bytes<std::vector<std::uint64_t>>(bytes_of(std::vector<std::uint64_t>())).empty());
  EXPECT_THROW(from_bytes<std::vector<std::uint64_t>>(bytes + "x"), cereal::Exception);
  std::string neither = bytes_of(true);
  neither.back() = 2;
  EXPECT_THROW(from_bytes<bool>(neither), cereal::Exception);
  std::string endless = bytes;
  endless[7] = 0x7f;  // of its length
  EXPECT_THROW(from_bytes<std::vector<std::uint64_t>>(endless), cereal::Exception);
  EXPECT_THROW(from_bytes<std::vector<std::uint64_t>>(bytes.substr(0, bytes.size() - 1)),
               cereal::Exception);
  EXPECT_THROW(from_bytes<std::vector<std::uint64_t>>(""), cereal::Exception);
  std::string big_endian = bytes;
  big_endian[0] = 0;
  EXPECT_THROW(from_bytes<std::vector<std::uint64_t>>(big_endian), cereal::Exception);
}

TEST(CheckpointBytes, ATallyOfOtherDevicesIsRefused) {
  const LoadedScenario scenario = small_scenario("arena", "arena.runs=3");
  RunCounting<Arena, ArenaRuns, ArenaPoint> counting(arena_measurement, scenario);
  CountedRuns<ArenaRuns> without_senders;
  without_senders.n = 1;
  without_senders.tally.tally.n_runs = 1;
  std::vector<std::vector<CountedRuns<ArenaRuns>>> forged(counting.points().size());
  forged[0] = {without_senders};
  counting.add(bytes_of(forged));
  EXPECT_THROW(counting.describe_all({}), Failure);
}

TEST(CheckpointBytes, RunsAreTakenOnce) {
  const LoadedScenario scenario = small_scenario("arena", "arena.runs=3");
  const std::string checkpoint = counted_shard(arena_measurement, scenario, {1, 3}, 1);
  RunCounting<Arena, ArenaRuns, ArenaPoint> counting(arena_measurement, scenario, {{1, 3}, {2, 3}});
  counting.add(checkpoint);
  EXPECT_THROW(counting.add(checkpoint), Failure);
  EXPECT_NO_THROW(counting.add(counted_shard(arena_measurement, scenario, {2, 3}, 1)));
  EXPECT_THROW(counting.add(counted_shard(arena_measurement, scenario, {3, 3}, 1)), Failure)
      << "another shard";
}

}  // namespace
}  // namespace sim
