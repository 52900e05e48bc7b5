// The parts of importance sampling, each against what it must be: readings against the chain,
// densities against nature, refusals. Sums of weights: weighted_test.cpp; results:
// rare_events_test.cpp.
#include <algorithm>
#include <cmath>
#include <vector>

#include "gtest/gtest.h"
#include "link_rule.hpp"
#include "scenarios.hpp"
#include "sim/link/importance_link.hpp"
#include "sim/link_experiment/link_measurement.hpp"
#include "sim/noise/peak_readings.hpp"
#include "sim/trial/drawn_trials.hpp"
#include "sim/trial/exposed_bits.hpp"
#include "sim/trial/matched_proposal.hpp"
#include "sim/trial/module_proposal.hpp"

namespace sim {
namespace {

/// A module that loses about one frame in ten thousand.
Link rare_link(std::vector<std::string> set = {}) {
  set.insert(set.begin(), {"receiver.module=TSSP4056", "receiver.ebn0_db=35.6",
                           "simulation.method=importance", "simulation.warmup_messages=1"});
  return link_of(set);
}

/// A trial's first long lit stretch: the start bit of a space is followed by five lit bits.
dsp::Seconds inside_lit_bit(const Link& link, const Transmission& sent) {
  const std::vector<ExposedBit> bits = exposed_bits(link, sent).back();
  for (std::size_t i = 2; i < bits.size(); ++i)
    if (bits[i].light && bits[i - 1].light) return (bits[i].begin + bits[i].end) * 0.5;
  ADD_FAILURE() << "no two lit bits in a row";
  return {};
}

/// One trial of a link alone, with noise prescribed everywhere.
struct Bench {
  Link link = rare_link();
  Transmission sent = transmit(link, 0);
  channel::ChainInput input = chain_input(link, 0, sent);
  PeakReadings peaks{link.chain.module, link.chain.carrier,
                     channel::fundamental_phase(link.chain.carrier, input.carrier_phase)};
  std::vector<float> normals = std::vector<float>(
      static_cast<std::size_t>(sent.line.end().value * link.chain.sample_rate.value) + 1, 1e-4f);

  std::vector<float> band_pass() {
    const channel::NoiseWindow window{0, static_cast<std::int64_t>(normals.size()), normals.data()};
    input.noise_windows = {&window, 1};
    channel::Recording recording;
    channel::propagate_alone(link.chain, input, &recording);
    return recording.band_pass;
  }
  std::int64_t peak() const {
    return peaks.first_from(inside_lit_bit(link, sent).value * link.chain.sample_rate.value);
  }
};

TEST(PeakReadings, AreWhereTheOutputPeaks) {
  Bench bench;
  const std::vector<float> output = bench.band_pass();
  for (std::int64_t peak = bench.peak(); peak < bench.peak() + 10; ++peak) {
    const double time = bench.peaks.time_of(peak);
    const auto first = output.begin() + static_cast<std::int64_t>(time - bench.peaks.cycle() / 2);
    const auto highest = std::max_element(first, first + 10) - output.begin() + 1;
    EXPECT_NEAR(static_cast<double>(highest), time, 0.6) << peak;
  }
}

TEST(PeakReadings, TellWhatNoiseTakesFromThePeak) {
  Bench bench;
  const std::vector<float> before = bench.band_pass();
  std::int64_t peak = bench.peak();  // one that is at a sample's end, where the output is recorded
  while (std::abs(bench.peaks.time_of(peak) - std::round(bench.peaks.time_of(peak))) > 0.15) ++peak;
  const NoiseReading reading = bench.peaks.reading(peak);
  constexpr float deviations = 3;
  for (std::size_t i = 0; i < reading.coefficients.size(); ++i)
    bench.normals[static_cast<std::size_t>(reading.first) + i] +=
        deviations * reading.coefficients[i];
  const auto at = static_cast<std::size_t>(std::llround(bench.peaks.time_of(peak))) - 1;
  const double taken = static_cast<double>(before[at] - bench.band_pass()[at]);
  EXPECT_NEAR(
      taken / (static_cast<double>(bench.link.chain.noise_lit) * bench.peaks.deviation(peak)),
      deviations, 0.01);
}

TEST(TrialNoise, ReadsWhatWasAdded) {
  const std::vector<float> tone{0.6f, 0.0f, 0.8f};
  const NoiseReading reading{105, tone}, apart{400, tone};
  TrialNoise noise({{100, 50}, {390, 20}}, {.seed = 1});
  const double before = noise.value(reading), there = noise.value(apart);
  noise.add(reading, 2);
  EXPECT_NEAR(noise.value(reading), before + 2, 1e-6);
  EXPECT_EQ(noise.value(apart), there);
  EXPECT_NEAR(covariance(reading, {107, tone}), 0.48, 1e-6);
  EXPECT_EQ(covariance(reading, {108, tone}), 0);
  ASSERT_EQ(noise.windows().size(), 2u);
  EXPECT_EQ(noise.windows()[1].first, 390);
}

/// A mean with its standard deviation.
struct Mean {
  double value, deviation;
};

Mean mean_of(const std::vector<double>& x) {
  const WeightedSum all = weighted_sum(x);
  const auto n = static_cast<double>(x.size());
  const double mean = all.sum / n;
  return {mean, std::sqrt((all.squares / n - mean * mean) / n)};
}

/// The probability by nature that noise fails some of a trial's spots, by so many draws of it as it
/// comes, or of the proposal, weighted.
Mean failing_share(const Link& link, const TrialProposal& trial, std::uint32_t draws, bool drawn) {
  std::vector<double> failing;
  for (std::uint32_t i = 0; i < draws; ++i) {
    TrialNoise noise(trial.stretches, address(link, i, Purpose::prescribed_noise));
    if (drawn) trial.proposal.draw(noise, address(link, i, Purpose::proposal));
    const double ratio = trial.proposal.ratio(noise);
    const double weight = drawn ? 1 / ratio : 1;
    failing.push_back(ratio > 1.001 * trial.proposal.natural_share() ? weight : 0);
  }
  return mean_of(failing);
}

/// The density of the proposal is right: weighted it finds what nature has.
void expect_right_density(const Link& link, const TrialProposal& trial, std::uint32_t draws,
                          std::uint32_t natural_draws) {
  ASSERT_LT(trial.proposal.natural_share(), 1);
  const Mean drawn = failing_share(link, trial, draws, true);
  const Mean natural = failing_share(link, trial, natural_draws, false);
  EXPECT_LT(drawn.deviation, 0.1 * drawn.value);
  EXPECT_LT(natural.deviation, 0.1 * natural.value);
  EXPECT_LT(std::abs(drawn.value - natural.value),
            3 * std::hypot(drawn.deviation, natural.deviation))
      << drawn.value << " and " << natural.value;
}

TEST(Proposal, MeasuredDensityOfAModuleIsRight) {
  const Link link = rare_link({"receiver.ebn0_db=35.1"});
  const DrawnTrials drawn = draw_trials(link, 0, 1);
  const std::vector<TrialProposal> trials = module_proposals(link, drawn, nullptr, nullptr);
  const TrialProposal& trial = trials.front();
  EXPECT_GT(trial.proposal.likelihood(), 0.1);
  expect_right_density(link, trial, 400, 800);
}

TEST(Proposal, MeasuredDensityOfAMatchedReceiverIsRight) {
  for (const char* receiver : {"ideal-coherent", "ideal-noncoherent"}) {
    const Link link =
        rare_link({std::string("receiver.module=") + receiver, "receiver.ebn0_db=10"});
    const DrawnTrials drawn = draw_trials(link, 0, 1);
    const TrialProposal trial =
        matched_proposal(link, drawn.sent[0], drawn.inputs[0].carrier_phase);
    expect_right_density(link, trial, 2000, 2000);
  }
}

TEST(Proposal, OfNothingIsTheNoiseAsItComes) {
  TrialNoise noise({{0, 64}}, {.seed = 3});
  const std::vector<float> before(noise.windows()[0].normals, noise.windows()[0].normals + 64);
  const Proposal nothing;
  nothing.draw(noise, {.seed = 4});
  EXPECT_TRUE(std::equal(before.begin(), before.end(), noise.windows()[0].normals));
  EXPECT_EQ(nothing.ratio(noise), 1);
}

// Hold 1.25 and integrator 8 cycles of 56 kHz are 9.75 of 59 kHz: the tenth pulse comes too late.
TEST(ModuleProposal, CountsThePulsesThatMustBeMissed) {
  channel::ModuleData module;
  module.centre_hz = 56e3;
  EXPECT_EQ(missed_cycles(module, dsp::Hertz(59e3), false), 9);
  EXPECT_EQ(missed_cycles(module, dsp::Hertz(56e3), false), 9);
  EXPECT_EQ(missed_cycles(module, dsp::Hertz(54e3), false), 8);
  EXPECT_EQ(missed_cycles(module, dsp::Hertz(59e3), true), 9);
}

/// Trials of a link with the noise as it comes: how many fail, how many of these the mixture knows,
/// and how many are of those in which so much is expected to fail that nothing else is drawn.
struct Known {
  int failed = 0, known = 0, expected = 0;
};

Known known_failures(const Link& link, std::uint32_t trials) {
  Known result;
  for (std::uint32_t first = 0; first < trials; first += 8) {
    DrawnTrials drawn = draw_trials(link, first, 8);
    const std::vector<TrialProposal> proposals = module_proposals(link, drawn, nullptr, nullptr);
    std::vector<TrialNoise> noises;
    for (std::uint32_t i = 0; i < 8; ++i) {
      noises.emplace_back(proposals[i].stretches,
                          address(link, first + i, Purpose::prescribed_noise));
      drawn.inputs[i].noise_windows = noises[i].windows();
    }
    std::vector<dsp::LogicTrace> pins =
        pins_of(link, pointers(drawn.sent), drawn.inputs, nullptr, nullptr);
    for (std::uint32_t i = 0; i < 8; ++i) {
      const Tally tally = count(link, drawn.sent[i], receive(link, first + i, std::move(pins[i])));
      if (tally.n_bit_errors == 0 && tally.n_frames_lost == 0) continue;
      ++result.failed;
      const Proposal& of = proposals[i].proposal;
      result.known += of.ratio(noises[i]) > 1.01 * of.natural_share();
      result.expected += of.natural_share() == 1 && of.likelihood() > 5;
    }
  }
  return result;
}

// What the mixture does not know is drawn as often as it comes: below 1e-5 never, and estimates are
// low without a sign of it.
TEST(ModuleProposal, MeasuredKnowsHowFramesFail) {
  for (const auto& [module, ebn0_db] :
       {std::pair("TSSP4056", "35.2"), std::pair("TSOP4156", "48.2"),
        std::pair("TSSP96056", "37.75")}) {
    const Link link = rare_link(
        {std::string("receiver.module=") + module, std::string("receiver.ebn0_db=") + ebn0_db});
    const auto [failed, known, expected] = known_failures(link, 320);
    EXPECT_GT(known, 15) << module;
    EXPECT_EQ(known + expected, failed) << module << ": " << known << " and " << expected;
  }
}

TEST(ExposedBits, AreTheMessageAndTheOneBefore) {
  const Link link = rare_link();
  const auto parts = exposed_bits(link, transmit(link, 0));
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].size(), 10 * link.bytes.size());
  EXPECT_LT(parts[0].front().share, 1);
  EXPECT_EQ(parts[0].back().share, 1);
  EXPECT_EQ(parts[1].size(), 10 * link.bytes.size());
  EXPECT_TRUE(parts[0].front().light);  // a start bit
  EXPECT_FALSE(parts[1].back().light);  // a stop bit
  EXPECT_EQ(exposed_bits(rare_link({"simulation.warmup_messages=0"}),
                         transmit(rare_link({"simulation.warmup_messages=0"}), 0))
                .size(),
            1u);
}

TEST(LinkDeterminism, WeightedTrialsToo) {
  const Link link = rare_link({"simulation.sample_rate_hz=250000"});
  const StopRule stop{.max_frames = 64};
  const LinkPoint one = run_point(link, stop, {.threads = 1});
  EXPECT_GT(one.tally.weighted.frames_lost.sum, 0);
  EXPECT_EQ(run_point(link, stop, {.threads = 8}).tally, one.tally);
  CountedRuns<LinkTally> part;
  for (const std::uint64_t frames : {24U, 64U})
    go_on(part, link, {.max_frames = frames}, {.threads = 2});
  EXPECT_EQ(part.tally.sum.tally, one.tally);
}

TEST(ScenarioRefusal, OfWhatImportanceSamplingCannotDo) {
  const std::string method = "simulation.method=importance";
  EXPECT_EQ(
      refusal("", {method, "receiver.module=ideal-coherent", "simulation.fidelity=decision"}),
      "simulation.method = \"importance\" in --set with simulation.fidelity in --set (weights "
      "are of a waveform's noise) use the fidelity waveform");
  EXPECT_EQ(refusal("", {method, "noise.scale=0"}),
            "simulation.method = \"importance\" in --set with noise.scale in --set (without noise "
            "there is nothing to draw) use the method brute-force");
  EXPECT_EQ(refusal("", {method, "stop.target_flr=0.1"}),
            "simulation.method = \"importance\" in --set with stop.target_flr in --set (weighted "
            "losses cannot be told from a level frame by frame) use --rel-ci or "
            "--max-frame-errors");
  EXPECT_EQ(refusal("", {method, "device.baud=10"}),
            "simulation.method = \"importance\" in --set with device.baud in --set (the noise of a "
            "message would not fit into memory) raise it, shorten the message or lower "
            "simulation.sample_rate_hz");
  EXPECT_EQ(refusal("", {method}), "accepted");
}

}  // namespace
}  // namespace sim
