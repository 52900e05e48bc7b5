// simulation.fidelity = "envelope": that it agrees with the waveform where it is allowed, that its
// trials are the same however they are run, and where it is refused.
//
// The 21 points that sim/README.md has compared, 3200 frames each, module and metres: TSSP4056
// 12.2, 12.4, 12.6; TSSP96056 12.2; TSOP4156 5.74, 6.5; TSOP4356 4; TSOP31156 5.2; TSOP34856 1.8,
// 2.1; TSOP4856 2.17, 2.5; TSOP57256 2.2; TSOP38256 1.8, 2.1; TSOP38456, TSOP4456 0.8; TSOP39556,
// TSOP94256 1; TSOP94456, TSOP94656 0.9.
#include <cmath>
#include <string>

#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/result/comparison.hpp"
#include "sim/threads/profile.hpp"
#include "sim/trace/trace.hpp"
#include "sim/trial/envelope_trial.hpp"

namespace sim {
namespace {

using Keys = std::vector<std::string>;

/// A point where some bits fail, and about how many.
struct Point {
  const char* module;
  const char* range_m;
  double ber;
  Keys more = {};
};

Tally tally_at(const Point& point, const char* fidelity, std::uint64_t frames) {
  const Link link = link_of(
      with_keys({std::string("receiver.module=") + point.module,
                 std::string("receiver.range_m=") + point.range_m,
                 std::string("simulation.fidelity=") + fidelity, "simulation.warmup_messages=1"},
                point.more));
  return run_point(link, {.max_frames = frames}, {.threads = 2}).tally;
}

/// Standard error of a bit error ratio whose bits fail together in a frame.
double standard_error(const Tally& t) {
  const auto n = static_cast<double>(t.n_frames), sum = static_cast<double>(t.n_bit_errors);
  const double variance = static_cast<double>(t.sum_bit_errors_squared) / n - sum * sum / (n * n);
  return std::sqrt(variance / n) * n / static_cast<double>(t.n_bits);
}

/// Whether 99 % intervals of the differences hold none.
void expect_agreement(const Point& point, std::uint64_t frames) {
  const Tally a = tally_at(point, "waveform", frames);
  const Tally b = tally_at(point, "envelope", 4 * frames);
  const double ber = ratio(a.n_bit_errors, a.n_bits);
  const std::string what = std::string(point.module) + " at " + point.range_m + " m";
  EXPECT_NEAR(std::log10(ber / point.ber), 0, 0.3) << what << ": " << ber;
  EXPECT_NEAR(ratio(b.n_bit_errors, b.n_bits), ber,
              2.576 * std::hypot(standard_error(a), standard_error(b)))
      << what;
  EXPECT_GT(fisher_exact(a.n_frames_lost, a.n_frames, b.n_frames_lost, b.n_frames), 0.01)
      << what << ": " << a.n_frames_lost << " of " << a.n_frames << " and " << b.n_frames_lost
      << " of " << b.n_frames;
}

const Keys short_pauses{"device.interval_min_ms=10", "device.interval_max_ms=20"};

// Without a slow AGC noise decides, 19 standard deviations below the threshold.
TEST(EnvelopeAgrees, MeasuredWhereNoiseDecides) {
  expect_agreement({"TSSP4056", "12.2", 1e-4, short_pauses}, 2000);
  expect_agreement({"TSSP4056", "12.4", 3.7e-3, short_pauses}, 800);
  expect_agreement({"TSSP4056", "12.6", 8e-2, short_pauses}, 80);
}

TEST(EnvelopeAgrees, MeasuredWhereTheGainDecides) {
  const Keys long_pauses{"device.interval_min_ms=300"};
  expect_agreement({"TSOP4156", "5.74", 6e-4, long_pauses}, 480);
  expect_agreement({"TSOP4156", "6.5", 4e-2, long_pauses}, 160);
  expect_agreement({"TSOP38256", "1.8", 1.1e-2, long_pauses}, 320);
  expect_agreement({"TSOP38256", "2.1", 4.2e-2, long_pauses}, 160);
  expect_agreement({"TSOP34856", "2.1", 1.9e-2, long_pauses}, 160);
  expect_agreement({"TSOP4856", "3", 8e-2, long_pauses}, 160);
  expect_agreement({"TSOP31156", "5.2", 4.5e-2, long_pauses}, 160);
}

// Pauses in which the gain does not always come back: all of it depends on the last one's length.
TEST(EnvelopeAgrees, MeasuredWherePausesAreShort) {
  expect_agreement({"TSOP38256", "1.8", 8.5e-2}, 320);
  expect_agreement({"TSOP4856", "2.5", 8e-2}, 320);
}

// A message that drew little jitter ends early; the pause behind it is no longer for that.
TEST(EnvelopeAgrees, MeasuredWhereCharactersJitter) {
  const Keys jitter{"device.start_jitter_us=5000", "device.interval_min_ms=20",
                    "device.interval_max_ms=20"};
  expect_agreement({"TSOP4856", "1.5", 0.39, jitter}, 320);
}

// With more samples a cycle, as near 60 kHz the waveform has whole cycles in its samples.
TEST(EnvelopeAgrees, MeasuredOffTheCentreAndAtAnotherDuty) {
  const Keys fine = with_keys(short_pauses, {"simulation.sample_rate_hz=1010000"});
  expect_agreement({"TSSP4056", "11.3", 4e-3, with_keys(fine, {"device.carrier_hz=60200"})}, 320);
  expect_agreement({"TSSP4056", "12.4", 2.6e-3, with_keys(fine, {"device.carrier_hz=53000"})}, 400);
  expect_agreement({"TSSP4056", "11.5", 1e-2, with_keys(fine, {"device.carrier_duty=0.3"})}, 320);
}

// What is accepted of a module ends here, or where its keys do.
TEST(EnvelopeAgrees, MeasuredAtTheCornersOfWhatIsAccepted) {
  const auto module = [](const char* set) {
    return with_keys(short_pauses, {std::string("module.") + set});
  };
  expect_agreement({"TSSP4056", "12.3", 3.5e-3, module("front_end_hz=4e4")}, 400);
  expect_agreement({"TSSP4056", "12.5", 1.8e-2, module("front_end_hz=2e5")}, 160);
  expect_agreement({"TSSP4056", "12.8", 2.6e-3, module("q=7")}, 320);
  expect_agreement({"TSSP4056", "9.6", 2.3e-2, module("q=30")}, 160);
  expect_agreement({"TSSP4056", "12.5", 1.1e-2, module("comparator_hold_cycles=1.1")}, 160);
  expect_agreement({"TSSP4056", "11.8", 1.6e-2, module("comparator_hold_cycles=20")}, 160);
  expect_agreement({"TSSP4056", "12.2", 8e-3, module("integrator_cycles=2")}, 160);
  expect_agreement({"TSSP4056", "12", 0.165, module("integrator_cycles=100")}, 160);
}

Keys keys(const Keys& more = {}) {
  return with_keys(
      {"simulation.fidelity=envelope", "receiver.range_m=2.3", "simulation.warmup_messages=1"},
      more);
}

TEST(Envelope, AGroupIsItsTrialsEachAlone) {
  for (const char* more : {"receiver.module=TSOP4156", "device.start_jitter_us=300",
                           "device.interval_min_ms=1", "receiver.module=TSOP4356"}) {
    const Link link = link_of(keys({"device.interval_max_ms=200", more}));
    Tally alone;
    for (std::uint32_t trial = 40; trial < 48; ++trial) {
      const Transmission sent = transmit(link, trial);
      alone += count(link, sent, receive(link, trial, envelope_pin(link, trial, sent)));
    }
    EXPECT_EQ(alone, run_group(link, 40, 8).tally) << more;
    Tally parts = run_group(link, 40, 3).tally;
    parts += run_group(link, 43, 5).tally;
    EXPECT_EQ(alone, parts) << more;
  }
}

// Of a pause only the end is computed; a message is heard all the same where pauses are as short
// as characters, and all of a trial is computed.
TEST(Envelope, HearsWhatIsSent) {
  for (const char* more :
       {"device.interval_max_ms=900", "device.interval_max_ms=1", "device.start_jitter_us=500"}) {
    const Link link =
        link_of(clear_link({"simulation.fidelity=envelope", "device.interval_min_ms=1", more}));
    EXPECT_EQ(run_group(link, 0, 8).tally.n_frames_ok, 8u) << more;
  }
}

TEST(Envelope, LeavesOutMostOfAPause) {
  const Link link = link_of(keys());
  ASSERT_EQ(link.envelope->stretches.size(), 2u);
  for (const EnvelopeLink::Stretch& stretch : link.envelope->stretches)
    EXPECT_LT(stretch.steps / 59e3, 0.4) << "s; a message takes 0.28 s";
  const Link dense = link_of(keys({"device.interval_min_ms=1"}));
  EXPECT_TRUE(dense.envelope->stretches.empty());
}

/// Least time from the end of a stretch to the begin of the next in some trials.
dsp::Seconds least_rest(const Link& link) {
  dsp::Seconds least(1e9);
  for (std::uint32_t trial = 0; trial < 16; ++trial) {
    const Transmission sent = transmit(link, trial);
    dsp::Seconds done(0);
    for (std::size_t i = 0; i < sent.messages.size(); ++i) {
      const auto [before, steps] = link.envelope->stretches[i];
      const dsp::Seconds begin = sent.messages[i].byte_start.front() - before;
      least = std::min(least, begin - done);
      done = begin + steps * dsp::period(link.envelope->chain.carrier);
    }
  }
  return least;
}

// A stretch has steps for the longest message; one without jitter ends earlier.
TEST(Envelope, StretchesDoNotOverlap) {
  const auto jittered = [](const char* min_ms, const char* jitter_us) {
    return link_of(
        keys({"receiver.module=TSOP4856", "simulation.warmup_messages=4",
              std::string("device.interval_min_ms=") + min_ms, "device.interval_max_ms=200",
              std::string("device.start_jitter_us=") + jitter_us}));
  };
  EXPECT_TRUE(jittered("20", "5000").envelope->stretches.empty());
  for (const char* jitter_us : {"0", "1000", "5000"})
    EXPECT_GE(least_rest(jittered("120", jitter_us)).value, 0) << jitter_us << " us";
}

TEST(Envelope, MakesNoSamples) {
  const LinkPoint point =
      run_point(link_of(keys()), {.max_frames = 8}, {.threads = 1, .profiled = true});
  EXPECT_EQ(point.n_samples, 0u);
  EXPECT_GT(point.simulated_s, 8 * 2 * 0.28);
  EXPECT_GT(point.profile.envelope_s, 0);
  EXPECT_NE(profile_lines(point.profile, 0).find("\n  envelope "), std::string::npos);
  const Scenario scenario = point_scenario(loaded("", keys()), {});
  EXPECT_TRUE(trace_trial(scenario, 3).taps.irradiance.empty());
  EXPECT_GT(trace_trial(scenario, 3).rx.edges().size(), 0u);
}

TEST(Envelope, IsRefusedWhereItWasNotCompared) {
  const std::string asked = "simulation.fidelity = \"envelope\" in --set with ";
  const auto refused = [](const Keys& more) { return refusal("", keys(more)); };
  EXPECT_EQ(refused({}), "accepted");
  EXPECT_EQ(refused({"receiver.module=ideal-coherent"}),
            asked +
                "receiver.module = \"ideal-coherent\" in --set (the envelope is that of a "
                "module) use the fidelity decision or waveform");
  EXPECT_EQ(refused({"receiver.population=1"}),
            asked +
                "receiver.population = 1 in --set (the envelope is designed once a point) use "
                "0 or the fidelity waveform");
  EXPECT_EQ(refusal("[disturbance.lamp]\nkind = \"pwm\"", keys()),
            asked +
                "disturbance.lamp.kind = \"pwm\" in x.toml:2 (the envelope is that of the "
                "device's light alone) remove that light or use the fidelity waveform");
  EXPECT_EQ(refused({"device.carrier_hz=61000"}),
            asked +
                "a carrier 0.0893 of f0 from it (the envelope is compared with the waveform up "
                "to 0.08) use the fidelity waveform");
  EXPECT_EQ(refused({"receiver.range_m=0.02"}),
            asked +
                "3.62 of the limiter's irradiance (the envelope is that of a linear input) use "
                "the fidelity waveform");
  EXPECT_NE(refused({"noise.scale=2"}).find("standard deviations of noise"), std::string::npos);
  EXPECT_EQ(refused({"module.q=6", "noise.scale=0.5"}),
            asked +
                "module.q = 6 in --set (the envelope is compared with the waveform from 7) use the "
                "fidelity waveform");
  EXPECT_NE(refused({"module.q=31"})
                .find("module.q = 31 in --set (the envelope is compared with "
                      "the waveform up to 30)"),
            std::string::npos);
  EXPECT_NE(refused({"module.front_end_hz=39999"}).find("from 40000)"), std::string::npos);
  EXPECT_NE(refused({"module.front_end_hz=2e6"}).find("up to 200000)"), std::string::npos);
  EXPECT_NE(refused({"module.comparator_hold_cycles=1"}).find("= 1 in --set (a pulse a cycle must"),
            std::string::npos);
  // Just beyond a limit a number is not printed as the limit.
  EXPECT_NE(refused({"device.carrier_hz=60480.4"}).find("carrier 0.08001 of f0 from it (the"),
            std::string::npos);
  EXPECT_NE(refused({"module.integrator_cycles=1"}).find("= 1 in --set (it counts in steps"),
            std::string::npos);
}

// Steps are counted in 31 bits: those of messages and pauses that are computed in one go.
TEST(Envelope, IsRefusedWhereItsStepsCannotBeCounted) {
  const auto refused = [](const Keys& more) { return refusal("", keys(more)); };
  const Keys hours{"device.interval_max_ms=1000000", "simulation.warmup_messages=100"};
  EXPECT_EQ(refused(hours), "accepted");
  EXPECT_EQ(refused(with_keys(hours, {"device.interval_min_ms=1"})),
            "simulation.fidelity = \"envelope\" in --set with messages and pauses of 5.902e+09 "
            "carrier cycles in one go (up to 2e+09 are counted) use a longer "
            "device.interval_min_ms, so that pauses are left out, or a shorter "
            "device.interval_max_ms, a shorter message or fewer simulation.warmup_messages");
  // The gain may settle for days: no longer than a pause.
  EXPECT_EQ(refused({"module.agc_attack_db_per_ms=1e-8"}), "accepted");
  const Keys fast{"device.carrier_hz=455000",      "module.centre_hz=455000",
                  "simulation.sample_rate_hz=2e6", "device.interval_min_ms=0",
                  "device.interval_max_ms=1e6",    "noise.scale=0.1"};
  EXPECT_NE(refused(with_keys(fast, {"simulation.warmup_messages=20"})).find("in one go"),
            std::string::npos);
  EXPECT_EQ(refused(with_keys(fast, {"simulation.warmup_messages=4"})), "accepted");
  const Keys slow{"device.baud=1", "device.interval_min_ms=0",
                  "device.message=" + std::string(64, 'A')};
  EXPECT_EQ(refused(with_keys(slow, {"simulation.warmup_messages=4"})), "accepted");
  EXPECT_NE(
      refused(with_keys(slow, {"simulation.warmup_messages=100", "device.interval_max_ms=2e5"}))
          .find("in one go"),
      std::string::npos);
  // Jitter may be longer than the pause; one message alone may be too long.
  EXPECT_NE(refused(with_keys(hours, {"device.interval_min_ms=20", "device.start_jitter_us=5000"}))
                .find("in one go"),
            std::string::npos);
  const Keys faster = with_keys(
      fast, {"device.carrier_hz=1e6", "module.centre_hz=1e6", "simulation.sample_rate_hz=4e6",
             "device.baud=1", "device.interval_min_ms=1e6", "simulation.warmup_messages=0"});
  EXPECT_EQ(refused(faster), "accepted");
  EXPECT_NE(
      refused(with_keys(faster, {"device.message=" + std::string(220, 'A')})).find("in one go"),
      std::string::npos);
}

}  // namespace
}  // namespace sim
