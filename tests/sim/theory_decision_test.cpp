// Matched receivers by one draw a bit (simulation.fidelity = "decision") against the closed forms,
// as theory_waveform_test.cpp does from the waveform, and against that waveform.
#include <cmath>
#include <string>

#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link/matched.hpp"
#include "sim/link/theory.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/result/comparison.hpp"
#include "theory_case.hpp"

namespace sim {
namespace {

Link decision_link(const std::string& module, double db, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {"receiver.module=" + module, "receiver.ebn0_db=" + std::to_string(db),
                             "simulation.warmup_messages=0", "simulation.fidelity=decision"});
  return link_of(more);
}

Tally tally_by_engine(const Link& link, std::uint64_t frames) {
  return run_point(link, {.max_frames = frames}, {.threads = 2}).tally;
}

/// More where errors are rare, which costs little.
std::uint64_t frames_at(double db) { return db < 9 ? 3000 : 300000; }

void expect_decision_ber(const Link& link, std::uint64_t frames, double theory) {
  expect_ber(link, tally_by_engine(link, frames), theory,
             std::to_string(link.operating.ebn0_db) + " dB");
}

TEST(TheoryDecision, MeasuredCoherent) {
  for (int db = 0; db <= 14; ++db)
    expect_decision_ber(decision_link("ideal-coherent", db), frames_at(db),
                        coherent_ook_ber(ratio_of(db)));
}

TEST(TheoryDecision, MeasuredNoncoherentAtTheOptimum) {
  for (int db = 0; db <= 14; ++db) {
    const Link link = decision_link("ideal-noncoherent", db);
    const double ebn0 = ratio_of(db);
    expect_decision_ber(
        link, frames_at(db),
        noncoherent_ook_ber(ebn0, {optimum_envelope_threshold(ebn0), lit_share(link.bytes)}));
  }
}

TEST(TheoryDecision, MeasuredThresholdsOffTheOptimum) {
  for (const double share : {0.3, 0.65, 1.2})
    for (const int db : {0, 6, 10}) {
      const std::vector<std::string> fixed{"module.detector_threshold=" + std::to_string(share)};
      const Link coherent = decision_link("ideal-coherent", db, fixed);
      const Link noncoherent = decision_link("ideal-noncoherent", db, fixed);
      const OokThreshold threshold{share * lit_amplitude(ratio_of(db)), lit_share(coherent.bytes)};
      expect_decision_ber(coherent, 3000, coherent_ook_ber(ratio_of(db), threshold));
      expect_decision_ber(noncoherent, 3000, noncoherent_ook_ber(ratio_of(db), threshold));
    }
}

/// Whether chance alone makes two shares differ so much in more than one of a hundred times.
void expect_same(std::uint64_t some, std::uint64_t of, std::uint64_t others,
                 std::uint64_t of_others, const std::string& what) {
  EXPECT_GT(fisher_exact(some, of, others, of_others), 0.01)
      << what << ": " << some << " of " << of << " and " << others << " of " << of_others;
}

/// The same link as waveform and as decision, a fixed seed each.
void expect_agreement(const std::string& module, double db, int warmups) {
  const std::vector<std::string> keys{"receiver.module=" + module,
                                      "receiver.ebn0_db=" + std::to_string(db),
                                      "simulation.sample_rate_hz=250000",
                                      "simulation.warmup_messages=" + std::to_string(warmups),
                                      "device.interval_min_ms=10",
                                      "device.interval_max_ms=20",
                                      "simulation.seed=5"};
  std::vector<std::string> decided = keys;
  decided.emplace_back("simulation.fidelity=decision");
  const Tally a = tally_by_engine(link_of(keys), 800), b = tally_by_engine(link_of(decided), 16000);
  const std::string what = module + " at " + std::to_string(db) + " dB: ";
  expect_same(a.n_bit_errors, a.n_bits, b.n_bit_errors, b.n_bits, what + "bits");
  expect_same(a.n_frames_lost, a.n_frames, b.n_frames_lost, b.n_frames, what + "frames");
  expect_same(a.n_frames_unended, a.n_frames, b.n_frames_unended, b.n_frames, what + "unended");
  expect_same(a.n_rejected_checksum, a.n_frames, b.n_rejected_checksum, b.n_frames,
              what + "checksums");
}

// Bit error ratios of about 1e-1, 1e-2 and 1e-3.
TEST(TheoryDecision, MeasuredAgreesWithTheWaveform) {
  for (const double db : {2.2, 7.3, 9.8}) expect_agreement("ideal-coherent", db, 0);
  for (const double db : {4.2, 8.4, 10.5}) expect_agreement("ideal-noncoherent", db, 0);
}

// A message whose end is missed spoils the next: the decoder remembers, if the receiver does not.
TEST(TheoryDecision, MeasuredMessagesBeforeTheCountedOneMatter) {
  expect_agreement("ideal-coherent", 9.8, 1);
  const auto lost = [](const char* warmups) {
    const Tally tally = tally_by_engine(decision_link("ideal-coherent", 9.8, {warmups}), 20000);
    return static_cast<double>(tally.n_frames_lost);
  };
  EXPECT_NEAR(lost("simulation.warmup_messages=1") / lost("simulation.warmup_messages=0"), 1.12,
              0.06);
}

}  // namespace
}  // namespace sim
