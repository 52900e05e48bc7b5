// Matched receivers, run from the waveform, against the closed forms (sim/link/theory.hpp):
// textbook formulas, Proakis & Salehi, "Digital Communications", 5th ed., 4.2 and 4.5. One trial is
// one message; its own share of light, .6 and not a half, is in the closed form.
#include <cmath>
#include <string>

#include "gtest/gtest.h"
#include "link_table.hpp"
#include "scenarios.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/link/matched.hpp"
#include "sim/link/theory.hpp"
#include "sim/trace/trace.hpp"
#include "sim/trial/trial.hpp"
#include "theory_case.hpp"

namespace sim {
namespace {

std::vector<std::string> keys_of(const std::string& module, double db,
                                 std::vector<std::string> more = {}) {
  std::string message;
  for (int i = 0; i < 8; ++i) message += "IND 011111 OK ";
  more.insert(more.begin(), {"receiver.module=" + module, "receiver.ebn0_db=" + std::to_string(db),
                             "device.message=" + message + "x", "simulation.warmup_messages=0",
                             "simulation.sample_rate_hz=300000"});
  return more;
}

constexpr std::uint32_t frames = 80;  // 94 400 bits

Tally waveform_tally(const Link& link) {
  Tally tally;
  for (std::uint32_t first = 0; first < frames; first += 8)
    tally += run_group(link, first, 8).tally;
  return tally;
}

void expect_waveform_ber(const Link& link, double theory, const std::string& what) {
  expect_ber(link, waveform_tally(link), theory, what);
}

TEST(TheoryWaveform, MeasuredCoherent) {
  for (int db = 0; db <= 14; ++db) {
    const Link link = link_of(keys_of("ideal-coherent", db));
    EXPECT_NEAR(link.operating.ebn0_db, db, 1e-9);
    expect_waveform_ber(link, coherent_ook_ber(ratio_of(db)), std::to_string(db) + " dB");
  }
}

// Told by the energy of a lit bit, the same points are 3.01 dB to the right.
TEST(TheoryWaveform, MeasuredCoherentByPeakEnergy) {
  for (const double peak_db : {3.0, 7.0, 10.0})
    expect_waveform_ber(link_of(keys_of("ideal-coherent", peak_db - 10 * std::log10(2.0))),
                        coherent_ook_ber_peak(ratio_of(peak_db)),
                        std::to_string(peak_db) + " dB peak");
}

TEST(TheoryWaveform, MeasuredNoncoherentAtTheOptimum) {
  for (int db = 0; db <= 14; ++db) {
    const Link link = link_of(keys_of("ideal-noncoherent", db));
    const double ebn0 = ratio_of(db);
    const double theory =
        noncoherent_ook_ber(ebn0, {optimum_envelope_threshold(ebn0), lit_share(link.bytes)});
    expect_waveform_ber(link, theory, std::to_string(db) + " dB");
  }
}

TEST(TheoryWaveform, MeasuredNoncoherentAtAFixedThreshold) {
  for (const double share : {0.4, 0.5, 0.65})
    for (const int db : {0, 4, 8, 11}) {
      const Link link = link_of(
          keys_of("ideal-noncoherent", db, {"module.detector_threshold=" + std::to_string(share)}));
      const double a = lit_amplitude(ratio_of(db));
      expect_waveform_ber(link,
                          noncoherent_ook_ber(ratio_of(db), {share * a, lit_share(link.bytes)}),
                          std::to_string(db) + " dB at " + std::to_string(share));
    }
}

TEST(TheoryWaveform, MeasuredNeitherSampleRateNorCarrierNorDutyMatters) {
  for (const char* key :
       {"simulation.sample_rate_hz=250000", "simulation.sample_rate_hz=700000",
        "device.carrier_hz=58800", "device.carrier_error_ppm=12345", "device.carrier_duty=0.3",
        "device.clock_error_ppm=20000", "device.start_jitter_us=500"})
    expect_waveform_ber(link_of(keys_of("ideal-coherent", 6, {key})), coherent_ook_ber(ratio_of(6)),
                        key);
}

// U3: 106 of the 170 line bits of `IND 011111 OK 46\n` are light.
TEST(Matched, ShareOfLight) { EXPECT_DOUBLE_EQ(lit_share(link_of({}).bytes), 106.0 / 170); }

// A module has its signal's shot noise in N0; the light is found all the same.
TEST(Matched, Ebn0SetsTheLightOfAModuleToo) {
  for (const double db : {-10.0, 10.0, 55.0}) {
    const Link link = link_of({"receiver.ebn0_db=" + std::to_string(db), "noise.scale=2"});
    EXPECT_NEAR(link.operating.ebn0_db, db, 1e-9);
    EXPECT_TRUE(std::isnan(link.operating.ber_theory));
    EXPECT_FALSE(link.ideal);
  }
}

TEST(Matched, Ebn0MakesTheGeometryALabel) {
  const auto light = [](const char* range, const char* ebn0) {
    return link_of({range, ebn0}).operating.irradiance_mw_per_m2;
  };
  EXPECT_EQ(light("receiver.range_m=1", "receiver.ebn0_db=9"),
            light("receiver.range_m=9", "receiver.ebn0_db=9"));
  EXPECT_NE(light("receiver.range_m=1", "receiver.ebn0_db=9"),
            light("receiver.range_m=1", "receiver.ebn0_db=10"));
}

// The geometry serves a matched receiver as well, with noise that does not depend on the bit.
TEST(Matched, NoiseIsThatOfTheDark) {
  const Link link = link_of({"receiver.module=ideal-coherent", "receiver.range_m=20"});
  EXPECT_EQ(link.chain.noise_lit, link.chain.noise_dark);
  EXPECT_NEAR(link.operating.ber_theory, coherent_ook_ber(ratio_of(link.operating.ebn0_db)), 1e-6);
  EXPECT_NEAR(link.operating.snr_db, link.operating.ebn0_db + 10 * std::log10(2.0), 1e-9);
}

TEST(Matched, TableHasTheoryBesideTheRatioWhereAsked) {
  LinkPoint point;
  point.tally.n_frames = 1;
  point.operating.ber_theory = 3.43e-5;
  EXPECT_NE(link_table({}, true).head().find("in theory"), std::string::npos);
  EXPECT_EQ(link_table({}).head().find("in theory"), std::string::npos);
  EXPECT_NE(link_table({}, true).row(point).find("3.43e-5"), std::string::npos);
  EXPECT_EQ(link_row(point).find("3.43e-5"), std::string::npos);
}

TEST(Matched, WithoutNoiseThereIsNoEbn0) {
  EXPECT_EQ(refusal("", {"receiver.ebn0_db=10", "noise.scale=0"}),
            "receiver.ebn0_db = 10 in --set with noise.scale = 0 in --set (without noise no light "
            "has this Eb/N0) raise noise.scale or remove receiver.ebn0_db");
}

TEST(Matched, DetectorIsOneOfThree) {
  const std::string part =
      "[[part]]\n\"modules/x.toml\" = '''\nname = \"x\"\ndetector = \"best\"\n'''\n"
      "[receiver]\nmodule = \"x\"\n";
  const std::string line = refusal(part);
  EXPECT_NE(line.find("detector = \"best\" in x.toml/modules/x.toml:2"), std::string::npos) << line;
  EXPECT_NE(line.find("\"coherent\" or \"noncoherent\""), std::string::npos) << line;
}

TEST(Matched, TheTrialThatIsTracedIsTheTrialThatWasCounted) {
  const Scenario scenario = point_scenario(loaded("", keys_of("ideal-noncoherent", 8)), {});
  const Link link = make_link(scenario);
  Tally one_by_one;
  for (std::uint32_t trial = 40; trial < 48; ++trial)
    one_by_one +=
        count(link, transmit(link, trial), receive(link, trial, trace_trial(scenario, trial).rx));
  EXPECT_EQ(one_by_one, run_group(link, 40, 8).tally);
  EXPECT_GT(one_by_one.n_bit_errors, 0u);
}

}  // namespace
}  // namespace sim
