// Recordings of hidden parts are what the chain itself makes of the same light.
#include "hidden_recording.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "channel/chain.hpp"
#include "hidden_part.hpp"

namespace hidden {
namespace {

constexpr DarkAround around{.before = 6000, .behind = 6000};

/// The wire of the LED that plays one step.
dsp::LogicTrace drive_of(const sim::PlanStep& step, double rate) {
  const double origin = static_cast<double>(around.before) / rate + step.start_ms * 1e-3;
  const auto cycle = [&](std::uint64_t n) { return static_cast<double>(n) / step.carrier_hz; };
  dsp::LogicTrace drive(true);
  for (std::uint64_t i = 0; i < step.repeats; ++i) {
    const double on = origin + static_cast<double>(i) * cycle(step.cycles_on + step.cycles_off);
    drive.add_edge(dsp::Seconds(on));
    drive.add_edge(dsp::Seconds(on + cycle(step.cycles_on)));
  }
  drive.observe_until(
      dsp::Seconds(origin + (sim::end_ms(step) - step.start_ms) * 1e-3 + 5000 / rate));
  return drive;
}

/// The chain's pin for one step, in samples; its carrier begins a cycle where the step begins.
std::vector<std::int64_t> chain_edges(const HiddenPart& part, const sim::PlanStep& step,
                                      double mw_per_m2, double rate) {
  const channel::ChainDesign design =
      channel::design_chain(part.module,
                            {.signal = dsp::WattsPerSquareMetre(mw_per_m2 * 1e-3),
                             .ambient = dsp::WattsPerSquareMetre(0),
                             .carrier = dsp::Hertz(step.carrier_hz)},
                            dsp::Hertz(rate));
  const dsp::LogicTrace drive = drive_of(step, rate);
  const double before = static_cast<double>(around.before) + step.start_ms * 1e-3 * rate;
  const double phase = -before * step.carrier_hz / rate;
  channel::ChainInput input{};
  input.drive = &drive;
  input.carrier_phase =
      static_cast<std::uint32_t>(std::llround((phase - std::floor(phase)) * 0x1p32));
  input.noise_seed = part.noise_seed;
  std::vector<std::int64_t> edges;
  const auto pins = channel::propagate(design, {&input, 1});
  for (const dsp::Seconds edge : pins.front().edges())
    edges.push_back(std::llround(edge.value * rate));
  return edges;
}

void expect_within_a_sample(const std::vector<std::int64_t>& edges,
                            const std::vector<std::int64_t>& expected) {
  ASSERT_EQ(edges.size(), expected.size());
  for (std::size_t i = 0; i < edges.size(); ++i)
    EXPECT_LE(std::abs(edges[i] - expected[i]), 1) << "edge " << i << " at " << expected[i];
}

// Noise included: it is drawn by the same seeds.
TEST(HiddenRecording, OfATsop4856IsWhatTheChainMakes) {
  for (const double level : {0.11, 0.2, 5.0, 300.0}) {
    for (const std::uint64_t on : {std::uint64_t{30}, std::uint64_t{60}, std::uint64_t{600}}) {
      const sim::Plan plan{{{.start_ms = 1.2345,
                             .carrier_hz = 55700,
                             .cycles_on = on,
                             .cycles_off = 200,
                             .repeats = 100}}};
      const HiddenPart part;
      const auto edges = edges_of(plan, {&part, 1}, level, around);
      const auto expected = chain_edges(part, plan.steps.front(), level, sample_rate_of(plan));
      EXPECT_GE(expected.size(), 6U) << level;  // the gain control lets go of many
      expect_within_a_sample(edges.front(), expected);
    }
  }
}

/// Edges in a span of samples.
std::vector<std::int64_t> between(const std::vector<std::int64_t>& edges, double from, double to) {
  std::vector<std::int64_t> some;
  for (const std::int64_t at : edges)
    if (static_cast<double>(at) >= from && static_cast<double>(at) < to) some.push_back(at);
  return some;
}

// Parts that differ, in dark that lets each step begin anew, without noise.
TEST(HiddenRecording, HasACarrierAndALevelAStepAndAPartALane) {
  const sim::Plan plan{
      {{0, 56000, 30, 500, 5, 0}, {1000, 52000, 40, 600, 4, -30}, {2000, 60000, 60, 600, 3, -45}}};
  const double rate = sample_rate_of(plan);
  std::vector<HiddenPart> parts(3);
  for (HiddenPart& part : parts) {
    part.module.feedback_ohm = 1e12;
    part.module.centre_hz = 55900;  // a tick of all lanes is that of each
  }
  parts[1].module.q = 7;
  parts[1].level_factor[level_key(-30)] = 0.9;
  parts[2].module.integrator_cycles = 5;
  parts[2].module.emin_mw_per_m2 = 0.2;
  const auto edges = edges_of(plan, parts, 100, around);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const sim::PlanStep& step : plan.steps) {
      const double level =
          100 * std::pow(10, step.level_db / 20) * level_factor(parts[i], step.level_db);
      const double from = static_cast<double>(around.before) + step.start_ms * 1e-3 * rate;
      const auto expected = chain_edges(parts[i], step, level, rate);
      EXPECT_EQ(expected.size(), 2 * step.repeats);
      expect_within_a_sample(between(edges[i], from, from + 0.9 * rate), expected);
    }
  }
}

TEST(HiddenRecording, IsInTheAnalysersTimeAndOnItsGrid) {
  const sim::Plan plan{{{0, 56000, 30, 500, 200, 0}}};
  HiddenPart part;
  part.start_s = 1.5;
  part.clock_error = 0.01;
  const sim::PinRecording recording = recordings_of(plan, {&part, 1}, 100).front();
  ASSERT_EQ(recording.pulses.size(), 200U);
  const double first = recording.pulses.front().start_s, last = recording.pulses.back().start_s;
  EXPECT_NEAR(first, 1.5 + 10 / 56e3, 10 / 56e3);
  EXPECT_NEAR(last - first, 1.01 * 199 * 530 / 56e3, 2 / 56e3);
  EXPECT_NEAR(recording.end_s, 1.5 + 1.01 * end_s(plan) + part.tail_s, 2e-6);
  for (const sim::PinPulse& pulse : recording.pulses)
    EXPECT_NEAR(pulse.end_s * 1e6, std::round(pulse.end_s * 1e6), 1e-6);
}

TEST(HiddenRecording, DoesNotDependOnThePartsBeside) {
  const sim::Plan plan{{{0, 38000, 30, 250, 200, 0}, {2000, 38000, 300, 300, 100, -30}}};
  const PartDraw draw{.seed = 3, .nominal_hz = 38e3};
  std::vector<HiddenPart> parts;
  for (std::uint32_t k = 0; k < most_parts; ++k) parts.push_back(draw_part(draw, k, plan));
  const auto together = recordings_of(plan, parts, 100);
  const auto alone = recordings_of(plan, {&parts[5], 1}, 100).front();
  ASSERT_EQ(alone.pulses.size(), together[5].pulses.size());
  for (std::size_t i = 0; i < alone.pulses.size(); ++i) {
    EXPECT_EQ(alone.pulses[i].start_s, together[5].pulses[i].start_s);
    EXPECT_EQ(alone.pulses[i].end_s, together[5].pulses[i].end_s);
  }
}

/// A train of short bursts, one of bursts beyond 300 cycles, a long carrier.
const sim::Plan agc_plan{{{0, 56000, 30, 60, 800, -60},
                          {2500, 56000, 600, 2400, 15, -60},
                          {4000, 56000, 20000, 0, 1, 0}}};

// With one broken part among them all are played to the module that knows how to break.
TEST(BrokenModule, IsTheChannelsWhereNothingIsBroken) {
  std::vector<HiddenPart> parts;
  for (std::uint32_t k = 0; k < most_parts; ++k)
    parts.push_back(draw_part({.seed = 7}, k, agc_plan));
  parts.front().module.agc_free_cycles = 20;  // with a train that it cannot keep
  parts.front().module.agc_max_duty = 0.05;
  const auto plain = edges_of(agc_plan, parts, 1000, around);
  parts.back().broken = Broken::linear_attack;
  const auto beside_a_broken = edges_of(agc_plan, parts, 1000, around);
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    EXPECT_GE(plain[i].size(), 20U) << i;
    EXPECT_EQ(plain[i], beside_a_broken[i]) << i;
  }
  EXPECT_NE(plain.back(), beside_a_broken.back());
}

TEST(BrokenModule, EachKindIsHeard) {
  std::vector<HiddenPart> parts(6);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].broken = static_cast<Broken>(i);
    parts[i].module.agc_max_duty = 0.05;
  }
  const auto edges = edges_of(agc_plan, parts, 1000, around);
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(edges[i] == edges[j]) << i << " is " << j;
}

TEST(HiddenPart, IsDrawnWithinItsBoundsAndAlike) {
  const sim::Plan plan{{{0, 38000, 30, 500, 5, 0}, {1000, 38000, 30, 500, 5, -20}}};
  EXPECT_EQ(nominal_of(plan), 38e3);
  const PartDraw draw{.seed = 7, .nominal_hz = nominal_of(plan)};
  int holding = 0;
  for (std::uint32_t k = 0; k < 300; ++k) {
    const HiddenPart part = draw_part(draw, k, plan);
    EXPECT_NEAR(part.module.centre_hz, 38e3, 0.03 * 38e3);
    EXPECT_EQ(part.level_factor.size(), 2U);
    for (const auto& [key, factor] : part.level_factor) EXPECT_NEAR(factor, 1, 0.1);
    EXPECT_EQ(part.module.q, draw_part(draw, k, plan).module.q);
    holding += part.module.agc_hold_ms > 0;
  }
  EXPECT_NEAR(holding, 100, 30);
}

}  // namespace
}  // namespace hidden
