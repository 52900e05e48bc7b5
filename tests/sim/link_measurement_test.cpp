// A link's trials: the same counts for any number of threads, stops where the rule says, counts
// exactly.
#include "sim/link_experiment/link_measurement.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "link_rule.hpp"
#include "scenarios.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/engine/run_counting.hpp"
#include "sim/failure.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

/// Fails about every other frame, AGC and noise both deciding; few samples, as sanitizers are slow.
Link middling_link(const std::string& seed = "1") {
  return link_of({"receiver.range_m=3", "ambient.irradiance_w_per_m2=20",
                  "simulation.sample_rate_hz=250000", "simulation.warmup_messages=1",
                  "simulation.seed=" + seed});
}

LinkPoint run(const Link& link, const StopRule& stop, int threads) {
  return run_point(link, stop, {.threads = threads});
}

TEST(LinkDeterminism, AnyNumberOfThreads) {
  const Link link = middling_link();
  const LinkPoint one = run(link, {.max_frames = 80}, 1);
  for (const int threads : {2, 8}) {
    const LinkPoint many = run(link, {.max_frames = 80}, threads);
    EXPECT_EQ(many.tally, one.tally) << threads;
    EXPECT_EQ(many.n_samples, one.n_samples) << threads;
  }
  EXPECT_GT(one.tally.n_frames_lost, 0u);
}

TEST(LinkDeterminism, SequentialStopToo) {
  const Link link = middling_link();
  const StopRule stop{.max_frames = 100000, .max_frame_errors = 10};
  const LinkPoint one = run(link, stop, 1);
  EXPECT_EQ(one.stop, StopReason::max_frame_errors);
  EXPECT_GE(one.tally.n_frames_lost, 10u);
  EXPECT_LT(one.tally.n_frames_lost, 10u + channel::lanes_per_group);
  for (const int threads : {2, 8}) EXPECT_EQ(run(link, stop, threads).tally, one.tally) << threads;
}

TEST(LinkMeasurement, SumIsThatOfItsGroups) {
  const Link link = middling_link();
  Tally sum;
  for (std::uint32_t first = 0; first < 40; first += 8) sum += run_group(link, first, 8).tally;
  EXPECT_EQ(run(link, {.max_frames = 40}, 2).tally, sum);
}

TEST(LinkMeasurement, CountsExactlyAsManyFramesAsAsked) {
  const Link link = link_of(clear_link());
  for (const std::uint64_t frames : {1u, 7u, 8u, 9u, 21u}) {
    const LinkPoint result = run(link, {.max_frames = frames}, 2);
    EXPECT_EQ(result.tally.n_frames, frames);
    EXPECT_EQ(result.stop, StopReason::max_frames);
    EXPECT_GT(result.simulated_s, 0);
  }
}

const std::vector<std::string> half_lost{"receiver.range_m=2.2", "simulation.sample_rate_hz=250000",
                                         "simulation.warmup_messages=1"};

TEST(LinkDeterminism, OfNoFramesIsOver) {
  const LinkPoint result = run(link_of(half_lost), {.max_frames = 0}, 2);
  EXPECT_EQ(result.stop, StopReason::max_frames);
  EXPECT_EQ(result.tally.n_frames, 0u);
}

// A point is finished as soon as its interval is as narrow as asked, and not a group before.
TEST(LinkDeterminism, MeasuredStopsWhereTheIntervalIsNarrow) {
  const Link link = link_of(half_lost);
  const StopRule stop{.max_frames = 100000, .rel_ci = 0.2};
  const LinkPoint result = run(link, stop, 2);
  const auto relative = [](const Tally& tally) {
    const Estimate e = bit_error_ratio(tally, 0.95);
    return (e.high - e.low) / 2 / e.value;
  };
  EXPECT_EQ(result.stop, StopReason::rel_ci);
  EXPECT_LE(relative(result.tally), 0.2);
  const std::uint64_t before = result.tally.n_frames - channel::lanes_per_group;
  EXPECT_GT(relative(run(link, {.max_frames = before}, 2).tally), 0.2);
  EXPECT_EQ(run(link, stop, 1).tally, result.tally);
}

TEST(LinkDeterminism, MeasuredStopsWhereTheLossIsTold) {
  const Link link = link_of(half_lost);
  const double flr = frame_loss_ratio(run(link, {.max_frames = 800}, 2).tally, 0.95).value;
  ASSERT_TRUE(flr > 0.05 && flr < 0.95) << flr;
  for (const double target : {flr / 2, (1 + flr) / 2}) {
    const StopRule stop{.max_frames = 100000, .target_flr = target};
    const LinkPoint result = run(link, stop, 2);
    EXPECT_EQ(result.stop, StopReason::target_flr);
    const Estimate e = frame_loss_ratio(result.tally, 0.999);
    EXPECT_TRUE(target < flr ? e.low > target : e.high < target) << target;
    EXPECT_EQ(run(link, stop, 3).tally, result.tally);
  }
}

// What is asked for costs time, not counts; what is not asked for is not measured.
TEST(LinkMeasurement, AProfileHasTheTimeOfEveryStage) {
  for (const char* receiver : {"TSOP4856", "ideal-coherent"}) {
    const Link link =
        link_of({std::string("receiver.module=") + receiver, "simulation.sample_rate_hz=250000"});
    const LinkPoint plain = run(link, {.max_frames = 16}, 2);
    const LinkPoint profiled =
        run_point(link, {.max_frames = 16}, {.threads = 2, .profiled = true});
    EXPECT_EQ(profiled.tally, plain.tally);
    EXPECT_EQ(plain.profile.decoding_s + plain.profile.chain_s[0], 0);
    const Profile& p = profiled.profile;
    for (const channel::ChainStage stage :
         {channel::ChainStage::noise, channel::ChainStage::light, channel::ChainStage::receiver})
      EXPECT_GT(p.chain_s.at(static_cast<std::size_t>(stage)), 0);
    EXPECT_GT(p.messages_s, 0);
    EXPECT_GT(p.decoding_s, 0);
  }
}

TEST(LinkMeasurement, InterruptKeepsWhatIsComplete) {
  const std::atomic<bool> interrupt = true;
  const LinkPoint result = run_point(link_of(clear_link()), {.max_frames = 4000000000u},
                                     {.threads = 2, .interrupt = &interrupt});
  EXPECT_EQ(result.stop, StopReason::interrupted);
  EXPECT_EQ(result.tally.n_frames % channel::lanes_per_group, 0u);
}

const StopRule endless{.max_frames = 4000000000u};

TEST(LinkMeasurement, AFailureToReportEndsThePoint) {
  const auto fails = [](const LinkPoint&) { throw Failure(ExitCode::environment, "no disk"); };
  EXPECT_THROW(run_point(link_of(clear_link()), endless, {.threads = 2}, fails), Failure);
}

#ifndef __SANITIZE_THREAD__  // gives threads stacks of its own size
/// Room for a few threads of a quarter of a gigabyte each.
class RoomForFewThreads {
 public:
  RoomForFewThreads() {
    pthread_getattr_default_np(&usual_);
    pthread_attr_t large;
    pthread_getattr_default_np(&large);
    pthread_attr_setstacksize(&large, stack);
    pthread_setattr_default_np(&large);
    ::getrlimit(RLIMIT_AS, &limit_);
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const rlimit narrow{pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + 5 * stack,
                        limit_.rlim_max};
    ::setrlimit(RLIMIT_AS, &narrow);
  }
  RoomForFewThreads(const RoomForFewThreads&) = delete;
  RoomForFewThreads& operator=(const RoomForFewThreads&) = delete;
  ~RoomForFewThreads() {
    ::setrlimit(RLIMIT_AS, &limit_);
    pthread_setattr_default_np(&usual_);
  }

 private:
  static constexpr std::size_t stack = std::size_t{1} << 28;
  pthread_attr_t usual_;
  rlimit limit_{};
};

TEST(LinkMeasurement, ThreadsThatDoNotStartEndThePoint) {
  const Link link = link_of(clear_link());
  const RoomForFewThreads room;
  std::string message = "no failure";
  try {
    run(link, endless, 8);
  } catch (const Failure& failure) {
    message = failure.what();
  }
  EXPECT_EQ(message,
            "cannot start 8 threads (Resource temporarily unavailable) use fewer --threads");
}
#endif

LinkResult experiment(const std::string& text) { return run_link(loaded(text), {.threads = 2}); }

const std::string base = R"([stop]
max_frames = 16
[simulation]
sample_rate_hz = 250000
warmup_messages = 1
[ambient]
irradiance_w_per_m2 = 20
[sweep]
)";

// Inserting a point into a sweep, or turning its axes, changes no other point.
TEST(LinkDeterminism, NeighboursInTheSweepDoNotMatter) {
  const auto two = experiment(base + "receiver.range_m = [2, 3]\n");
  const auto three = experiment(base + "receiver.range_m = [2, 2.5, 3]\n");
  EXPECT_EQ(two.points[0].tally, three.points[0].tally);
  EXPECT_EQ(two.points[1].tally, three.points[2].tally);
  EXPECT_NE(three.points[1].tally, three.points[2].tally);
}

TEST(LinkMeasurement, ProgressIsWhatAnInterruptLeaves) {
  std::atomic<bool> interrupt = false;
  const LoadedScenario scenario =
      loaded(base + "stop.max_frames = [4e9, 16]\n", {"stop.max_frame_errors=0"});
  RunCounting counting(link_measurement, scenario);
  LinkPoint seen;
  const RunCounters by{{.threads = 2, .interrupt = &interrupt}};
  for (std::size_t i = 0; i < 2; ++i)
    counting.count(i, by, [&](std::uint32_t done, std::uint32_t) {
      counting.describe_current();
      seen = counting.points()[i];
      EXPECT_EQ(seen.tally.n_frames, done);
      interrupt = interrupt || done > 0;
    });
  EXPECT_EQ(seen.coordinates, std::vector<double>{4e9});
  EXPECT_EQ(seen.stop, StopReason::interrupted);
  EXPECT_GT(seen.n_samples, 0u);
  EXPECT_GE(counting.points()[0].tally.n_frames, seen.tally.n_frames);
  EXPECT_FALSE(counting.points()[1].reached());
}

// Interrupted anywhere and gone on with, by other numbers of threads, a point ends the same.
TEST(LinkDeterminism, AnInterruptedPointEndsAsIfNothingHadBeen) {
  const Link link = link_of(
      {"receiver.range_m=2.2", "simulation.sample_rate_hz=250000", "simulation.warmup_messages=1"});
  for (const StopRule& stop :
       {StopRule{.max_frames = 45}, {.max_frames = 200, .max_frame_errors = 20}}) {
    const LinkPoint whole = run(link, stop, 2);
    CountedRuns<LinkTally> part;
    for (int interrupts = 0; !part.stop; ++interrupts) {
      std::atomic<bool> interrupt = false;
      const std::uint32_t before = part.n;
      const double elapsed_s = part.tally.elapsed_s;
      go_on(part, link, stop, {.threads = 1 + interrupts % 3, .interrupt = &interrupt},
            [&] { interrupt = part.n > before; });
      EXPECT_GE(part.tally.elapsed_s, elapsed_s);
    }
    EXPECT_EQ(part.tally.sum.tally, whole.tally);
    EXPECT_EQ(*part.stop, whole.stop);
    EXPECT_DOUBLE_EQ(part.tally.sum.simulated_s, whole.simulated_s);
    EXPECT_EQ(part.tally.sum.n_samples, whole.n_samples);
  }
}

TEST(LinkMeasurement, GridIsRowMajor) {
  const auto result =
      experiment(base + "receiver.range_m = [2, 3]\ndevice.carrier_hz = [56000, 59000]\n");
  ASSERT_EQ(result.points.size(), 4u);
  EXPECT_EQ(result.points[1].coordinates, (std::vector<double>{2, 59000}));
  EXPECT_EQ(result.points[2].coordinates, (std::vector<double>{3, 56000}));
  EXPECT_EQ(result.points[1].operating.irradiance_mw_per_m2,
            result.points[0].operating.irradiance_mw_per_m2);
  EXPECT_LT(result.points[1].operating.snr_db, result.points[0].operating.snr_db);
}

TEST(LinkDeterminism, SeedsGiveOtherNoise) {
  const auto with_seed = [](const char* seed) {
    return run(middling_link(seed), {.max_frames = 40}, 2).tally;
  };
  EXPECT_EQ(with_seed("7"), with_seed("7"));
  EXPECT_NE(with_seed("7"), with_seed("8"));
}

}  // namespace
}  // namespace sim
