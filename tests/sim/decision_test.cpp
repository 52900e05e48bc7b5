// simulation.fidelity = "decision": trials whose bits are drawn one by one count what the decoder
// makes of them, whoever runs them; and where it is refused.
#include "sim/trial/decision_trial.hpp"

#include <string>

#include "gtest/gtest.h"
#include "link_rule.hpp"
#include "link_table.hpp"
#include "scenarios.hpp"
#include "sim/counting/shard.hpp"
#include "sim/engine/run_counting.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/scenario/canonical_text.hpp"
#include "sim/threads/profile.hpp"
#include "sim/trace/trace.hpp"

namespace sim {
namespace {

std::vector<std::string> keys(std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"receiver.module=ideal-coherent", "receiver.ebn0_db=9",
                             "simulation.fidelity=decision", "simulation.warmup_messages=1"});
  return more;
}

/// The same trials one by one, each decoded in full.
Tally one_by_one(const Link& link, std::uint32_t first, std::uint32_t n) {
  Tally tally;
  for (std::uint32_t trial = first; trial < first + n; ++trial) {
    const Transmission sent = transmit(link, trial);
    tally += count(link, sent, receive(link, trial, decided_pin(link, trial, sent)));
  }
  return tally;
}

TEST(DecisionDeterminism, AGroupIsItsTrialsEachAloneAndDecoded) {
  for (const char* more :
       {"device.start_jitter_us=300", "uart.receiver=mid-bit", "receiver.ebn0_db=3",
        "receiver.module=ideal-noncoherent", "device.clock_error_ppm=19000",
        "device.clock_error_ppm=48000", "device.message=U"}) {
    const Link link = link_of(keys({more}));
    Tally groups;
    for (std::uint32_t first = 4711; first < 4711 + 64; first += 8)
      groups += run_group(link, first, 8).tally;
    EXPECT_EQ(groups, one_by_one(link, 4711, 64)) << more;
    EXPECT_GT(groups.n_bit_errors, 0u) << more;
    EXPECT_EQ(run_group(link, 16, 5).tally, one_by_one(link, 16, 5)) << more;
  }
}

/// The wire of the LED one bit late: what is heard of it without a wrong bit.
dsp::LogicTrace right_pin(const Link& link, const Transmission& sent) {
  dsp::LogicTrace pin(true);
  for (const dsp::Seconds edge : sent.line.edges()) pin.add_edge(edge + link.delay);
  pin.observe_until(sent.line.end() + link.delay);
  return pin;
}

// Up to the largest error of clocks at which it is used, at any phase of the UART's clock.
TEST(Decision, ATrialWithoutAWrongBitCountsAsItsDecodedPin) {
  for (const char* clock :
       {"uart.clock_error_ppm=0", "uart.clock_error_ppm=19500", "uart.clock_error_ppm=-19500"})
    for (const char* uart : {"uart.receiver=atmega", "uart.receiver=mid-bit"})
      for (const char* more : {"device.start_jitter_us=0", "device.start_jitter_us=900",
                               "device.interval_min_ms=0", "device.message=~~~~~ ~~~~~"}) {
        const Link link = link_of(keys({clock, uart, more, "device.interval_max_ms=100"}));
        ASSERT_TRUE(link.decisions->clean);
        for (std::uint32_t trial = 0; trial < 50; ++trial) {
          const Transmission sent = transmit(link, trial);
          ASSERT_EQ(count(link, sent, receive(link, trial, right_pin(link, sent))),
                    *link.decisions->clean)
              << clock << " " << uart << " " << more;
        }
      }
  const Tally clean = *link_of(keys()).decisions->clean;
  EXPECT_EQ(clean.n_frames_ok, 1u);
  EXPECT_EQ(clean.n_bits, 170u);
  EXPECT_EQ(clean.n_bit_errors, 0u);
}

TEST(Decision, ClocksFarApartLeaveEveryTrialToTheDecoder) {
  const Link link = link_of(keys({"uart.clock_error_ppm=-60000", "receiver.ebn0_db=30"}));
  EXPECT_FALSE(link.decisions->clean);
  const Tally tally = run_group(link, 0, 8).tally;
  EXPECT_EQ(tally.n_bit_errors, 0u);
  EXPECT_EQ(tally.n_frames_lost, 8u) << "right bits, read wrong";
}

TEST(DecisionDeterminism, AnyNumberOfThreadsAndAnyInterrupt) {
  const Link link = link_of(keys());
  for (const StopRule& stop :
       {StopRule{.max_frames = 12345}, {.max_frames = 1000000, .max_frame_errors = 500}}) {
    const LinkPoint whole = run_point(link, stop, {.threads = 1});
    EXPECT_GT(whole.tally.n_frames_lost, 0u);
    for (const int threads : {2, 8})
      EXPECT_EQ(run_point(link, stop, {.threads = threads}).tally, whole.tally) << threads;
    CountedRuns<LinkTally> part;
    go_on(part, link, {.max_frames = 808}, {.threads = 2});
    go_on(part, link, stop, {.threads = 3});
    EXPECT_EQ(part.tally.sum.tally, whole.tally);
    EXPECT_NEAR(part.tally.sum.simulated_s / whole.simulated_s, 1, 1e-12);
  }
}

TEST(DecisionDeterminism, ShardsAddUpToTheWhole) {
  const LoadedScenario scenario =
      loaded("", keys({"stop.max_frames=3003", "stop.max_frame_errors=0"}));
  Tally sum;
  for (const std::uint32_t number : {1u, 2u, 3u}) {
    RunCounting shard(link_measurement, scenario, {{number, 3}});
    shard.count(0, {{.threads = 2}});
    sum += shard.points()[0].tally;
  }
  EXPECT_EQ(sum, run_link(scenario, {.threads = 2}).points[0].tally);
}

TEST(DecisionDeterminism, TheTrialThatIsTracedIsTheTrialThatWasCounted) {
  const Scenario scenario = point_scenario(loaded("", keys({"receiver.ebn0_db=6"})), {});
  const Link link = make_link(scenario);
  Tally traced;
  for (std::uint32_t trial = 40; trial < 48; ++trial)
    traced +=
        count(link, transmit(link, trial), receive(link, trial, trace_trial(scenario, trial).rx));
  EXPECT_EQ(traced, run_group(link, 40, 8).tally);
  EXPECT_GT(traced.n_bit_errors, 0u);
  EXPECT_TRUE(trace_trial(scenario, 40).taps.irradiance.empty());
}

TEST(Decision, SimulatesTimeButNoSamples) {
  const Link decided = link_of(keys()), sampled = link_of(keys({"simulation.fidelity=waveform"}));
  double decided_s = 0, sampled_s = 0;
  for (std::uint32_t first = 0; first < 800; first += 8) {
    const GroupResult group = run_group(decided, first, 8);
    EXPECT_EQ(group.n_samples, 0u);
    decided_s += group.simulated_s;
    for (std::uint32_t i = first; i < first + 8; ++i)
      sampled_s += transmit(sampled, i).line.end().value;
  }
  EXPECT_NEAR(decided_s / sampled_s, 1, 0.03) << "the mean of pauses from 0.1 to 0.9 s";
}

TEST(Decision, ProfileHasNoSamplesToDivideBy) {
  const LinkPoint point =
      run_point(link_of(keys()), {.max_frames = 800}, {.threads = 2, .profiled = true});
  EXPECT_GT(point.profile.decisions_s, 0);
  EXPECT_GT(point.profile.decoding_s, 0);
  const std::string lines = profile_lines(point.profile, point.n_samples);
  EXPECT_NE(lines.find("\n  decisions "), std::string::npos) << lines;
  for (const char* nonsense : {"inf", "nan", "noise", "light"})
    EXPECT_EQ(lines.find(nonsense), std::string::npos) << lines;
}

TEST(Decision, TableShowsHowManyTimesFasterThanTheLinkInFewDigits) {
  LinkPoint point;
  point.tally.n_frames = 1;
  point.elapsed_s = 1;
  point.simulated_s = 2.34e6;
  EXPECT_NE(link_row(point).find(" 2.3e6x "), std::string::npos);
  point.simulated_s = 234567;
  EXPECT_NE(link_row(point).find("234567x "), std::string::npos);
}

// ---- the key ----

TEST(Fidelity, ItsDefaultIsNoPartOfThePoint) {
  const Scenario standard = loaded("").base;
  EXPECT_EQ(canonical_text(standard).find("fidelity"), std::string::npos);
  EXPECT_EQ(canonical_text(loaded("simulation.fidelity = 'waveform'").base),
            canonical_text(standard));
  EXPECT_NE(canonical_text(loaded("", keys()).base).find("simulation.fidelity = \"decision\""),
            std::string::npos);
}

TEST(Fidelity, CanBeSwept) {
  const LoadedScenario scenario =
      loaded("", keys({"simulation.fidelity=waveform,decision", "stop.max_frames=16"}));
  EXPECT_FALSE(make_link(point_scenario(scenario, {0})).decisions);
  EXPECT_TRUE(make_link(point_scenario(scenario, {1})).decisions);
}

TEST(Fidelity, DecisionIsForIdealReceiversInWhiteNoise) {
  EXPECT_EQ(refusal("[simulation]\nfidelity = \"decision\""),
            "simulation.fidelity = \"decision\" in x.toml:2 with receiver.module = \"TSOP4856\" by "
            "default (a module has more to it than one decision a bit) use ideal-coherent, "
            "ideal-noncoherent or the fidelity waveform");
  EXPECT_EQ(
      refusal("[simulation]\nfidelity = \"decision\"\n[receiver]\nmodule = "
              "\"ideal-coherent\"\n[disturbance.lamp]\nkind = \"pwm\""),
      "simulation.fidelity = \"decision\" in x.toml:2 with disturbance.lamp.kind = \"pwm\" in "
      "x.toml:6 (decisions are drawn for white noise alone) remove that light or use the "
      "fidelity waveform");
  EXPECT_EQ(
      refusal("", {"receiver.module=ideal-coherent,TSOP4856", "simulation.fidelity=decision"}),
      "simulation.fidelity = \"decision\" in --set with receiver.module = \"TSOP4856\" in "
      "--set (a module has more to it than one decision a bit) use ideal-coherent, "
      "ideal-noncoherent or the fidelity waveform");
  EXPECT_EQ(refusal("simulation.fidelity = \"best\""),
            "simulation.fidelity = \"best\" in x.toml:1 (the fidelity of light and receiver is "
            "one of a list) use waveform or envelope or decision");
}

}  // namespace
}  // namespace sim
