// The bit error ratio of a waveform's samples: that of the closed form where samples are many and
// noise is strong, and more where bits differ. It is the truth of importance sampling, which does
// not see the closed form.
#include "sim/link/sampled_theory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "scenarios.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/link_experiment/link_notes.hpp"
#include "tests/sim/held_intervals.hpp"

namespace sim {
namespace {

Link link_at(const std::string& ebn0_db, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"receiver.module=ideal-coherent", "receiver.ebn0_db=" + ebn0_db,
                             "simulation.warmup_messages=0"});
  return link_of(more);
}

double excess_of(const Link& link) {
  return link.operating.ber_sampled / link.operating.ber_theory - 1;
}

TEST(SampledTheory, IsNearTheClosedForm) {
  for (const char* module : {"ideal-coherent", "ideal-noncoherent"}) {
    const Link link = link_at("4", {"receiver.module=" + std::string(module)});
    EXPECT_NEAR(excess_of(link), 0, 0.002) << module;
  }
}

// By another program's sum over the bits of 3000 trials: 2.5 %, 4.0 %, 19.6 %, 1.2 %.
TEST(SampledTheory, GrowsWithLightAndWithFewSamplesACycle) {
  const std::string few = "simulation.sample_rate_hz=300000";
  EXPECT_NEAR(excess_of(link_at("14", {few})), 0.025, 0.002);
  EXPECT_NEAR(excess_of(link_at("15.5", {few})), 0.040, 0.003);
  EXPECT_NEAR(excess_of(link_at("14", {few, "device.carrier_hz=60000"})), 0.196, 0.008);
  EXPECT_NEAR(excess_of(link_at("14", {"simulation.sample_rate_hz=1200000"})), 0.012, 0.002);
}

TEST(SampledTheory, IsNotOfDecisions) {
  EXPECT_TRUE(std::isnan(link_at("4", {"simulation.fidelity=decision"}).operating.ber_sampled));
}

LinkPoint told_point(double theory, double sampled, std::uint64_t errors) {
  LinkPoint point;
  point.operating.ber_theory = theory;
  point.operating.ber_sampled = sampled;
  point.tally.n_frames = 100;
  point.tally.n_bits = 17'000;
  point.tally.n_bit_errors = errors;
  return point;
}

// Where it is bright no bit fails, and no ratio of theories means anything.
TEST(SampledTheory, IsToldOfPointsWhereBitsFailed) {
  LinkResult result;
  result.points = {told_point(1e-2, 1.01e-2, 170), told_point(1e-3, 1.03e-3, 17),
                   told_point(1e-50, 1e-48, 0), told_point(0, 1e-300, 0)};
  EXPECT_EQ(
      mark_notes(result),
      "in theory all bits are alike; sampled they are not, and make up to 3.0 % more errors\n");
  result.points.erase(result.points.begin(), result.points.begin() + 2);
  EXPECT_EQ(mark_notes(result), "");
}

Estimate importance_ber(const Link& link, std::uint64_t frames, double level) {
  const Tally tally = run_point(link, {.max_frames = frames}, {.threads = threads_for(0)}).tally;
  return bit_error_ratio(tally, level);
}

// At five samples a cycle bits measure 2 % more or less by the carrier's phase, so those that fail
// most do so at less noise than others.
TEST(SampledTheory, MeasuredImportanceFindsTheBitsThatMeasureLess) {
  const Link link = link_at("14", {"simulation.method=importance", "device.carrier_hz=60000",
                                   "simulation.sample_rate_hz=300000"});
  const Estimate ber = importance_ber(link, 1600, 0.999);
  EXPECT_LE(ber.low, link.operating.ber_sampled);
  EXPECT_GE(ber.high, link.operating.ber_sampled);
}

// Of the envelope, and where a bit has few samples, some of which it shares with a lit neighbour.
TEST(SampledTheory, MeasuredImportanceAgreesOfOtherReceiversAndRates) {
  for (const char* key : {"receiver.module=ideal-noncoherent", "device.baud=3000"}) {
    const Link link =
        link_at("14", {"simulation.method=importance", "simulation.sample_rate_hz=300000", key});
    const Estimate ber = importance_ber(link, 1600, 0.999);
    EXPECT_LE(ber.low, link.operating.ber_sampled) << key;
    EXPECT_GE(ber.high, link.operating.ber_sampled) << key;
  }
}

/// The interval of 200 frames, as they are drawn to fail.
held::Experiment importance(const std::string& ebn0_db, const std::string& carrier_hz) {
  return [=](std::uint64_t seed) -> std::optional<held::Printed> {
    const Link link = link_at(
        ebn0_db, {"simulation.method=importance", "simulation.sample_rate_hz=300000",
                  "device.carrier_hz=" + carrier_hz, "simulation.seed=" + std::to_string(seed)});
    const Estimate ber = importance_ber(link, 200, 0.95);
    if (std::isnan(ber.value)) return std::nullopt;
    return held::Printed{ber.low, ber.high, link.operating.ber_sampled};
  };
}

TEST(HeldIntervals, MeasuredOfImportance) {
  struct Case {
    std::string ebn0_db, carrier_hz;
  };
  for (const auto& [ebn0_db, carrier_hz] :
       {Case{"14", "59000"}, Case{"15.5", "59000"}, Case{"14", "60000"}})
    held::expect_to_hold({.interval = "BER",
                          .setting = "importance, ideal-coherent at " + ebn0_db + " dB, " +
                                     carrier_hz + " Hz, 300 kS/s, -n 200, of its samples",
                          .gate_seeds = 4},
                         importance(ebn0_db, carrier_hz));
}

}  // namespace
}  // namespace sim
