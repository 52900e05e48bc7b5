// The chain as its envelope: lanes, instruction sets and stretches; single edges against the
// waveform. Whole links: tests/sim/envelope_test.cpp.
#include "channel/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "channel/chain.hpp"
#include "channel/envelope_receiver.hpp"
#include "channel/noise.hpp"
#include "channel/receiver_module.hpp"
#include "gtest/gtest.h"

namespace channel {
namespace {

constexpr dsp::Hertz rate(600e3);

LightSettings light_of(double mw_per_m2, double noise_scale = 1) {
  return {.signal = dsp::WattsPerSquareMetre(mw_per_m2 * 1e-3),
          .ambient = dsp::WattsPerSquareMetre(0.6),
          .carrier = dsp::Hertz(59e3),
          .noise_scale = noise_scale};
}

struct Chains {
  ChainDesign waveform;
  EnvelopeChain envelope;

  Chains(const ModuleData& module, const LightSettings& light)
      : waveform(design_chain(module, light, rate)),
        envelope(design_envelope(module, light, waveform)) {}
};

/// `n` bursts of a length, as far apart, from 20 ms on.
dsp::LogicTrace train(int n, dsp::Seconds length) {
  dsp::LogicTrace drive(true);
  for (int i = 0; i < 2 * n; ++i) drive.add_edge(dsp::Seconds(20e-3) + i * length);
  drive.observe_until(dsp::Seconds(30e-3) + 2 * n * length);
  return drive;
}

std::int32_t blocks_of(double steps) {
  return static_cast<std::int32_t>(std::ceil(steps / envelope_block)) * envelope_block;
}

std::vector<std::int32_t> whole(const dsp::LogicTrace& drive, const EnvelopeChain& chain) {
  return {blocks_of(dsp::cycles(drive.end(), chain.carrier) + 1)};
}

std::vector<EnvelopeInput> trials(const dsp::LogicTrace& drive) {
  std::vector<EnvelopeInput> inputs;
  for (std::uint32_t i = 0; i < 19; ++i)  // more than any kernel has lanes for
    inputs.push_back({.drive = &drive,
                      .carrier_phase = i * 0x1234567u,
                      .noise_seed = {i + 1, 2, 3, 4},
                      .begins = {dsp::Seconds(0)}});
  return inputs;
}

/// Near the threshold, where noise decides.
constexpr double faint_mw_per_m2 = 0.215;

TEST(Envelope, LanesAreTrialsAlone) {
  const Chains chains(ModuleData{}, light_of(faint_mw_per_m2));
  const dsp::LogicTrace drive = train(20, dsp::Seconds(1.7e-3));
  const auto inputs = trials(drive);
  const auto steps = whole(drive, chains.envelope);
  const auto pins = propagate_envelopes(chains.envelope, inputs, steps);
  EXPECT_NE(pins[0], pins[1]);
  for (std::size_t i = 0; i < pins.size(); ++i) {
    EXPECT_GT(pins[i].edges().size(), 0u);
    EXPECT_EQ(pins[i], propagate_envelope(chains.envelope, inputs[i], steps)) << i;
  }
}

TEST(Envelope, InstructionSetsAgree) {
  const Chains chains(ModuleData{}, light_of(faint_mw_per_m2));
  const dsp::LogicTrace drive = train(20, dsp::Seconds(1.7e-3));
  const auto inputs = trials(drive);
  const auto steps = whole(drive, chains.envelope);
  const auto best = propagate_envelopes(chains.envelope, inputs, steps);
  for (const InstructionSet set : {InstructionSet::v3, InstructionSet::baseline})
    EXPECT_EQ(propagate_envelopes(chains.envelope, inputs, steps, nullptr, set), best);
}

TEST(Envelope, FewerTrialsThanLanesAreTheSame) {
  const Chains chains(ModuleData{}, light_of(faint_mw_per_m2));
  const dsp::LogicTrace drive = train(8, dsp::Seconds(1.7e-3));
  const auto inputs = trials(drive);
  const auto steps = whole(drive, chains.envelope);
  const auto all = propagate_envelopes(chains.envelope, inputs, steps);
  const auto few = propagate_envelopes(chains.envelope, {inputs.data(), 3}, steps);
  ASSERT_EQ(few.size(), 3u);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i], all[i]);
}

/// Mean delay of the pin's edges behind those of the drive, in carrier cycles: of falls (light) or
/// rises.
double mean_delay(const dsp::LogicTrace& drive, const std::vector<dsp::LogicTrace>& pins,
                  std::size_t kind) {
  double sum = 0, n = 0;
  for (const dsp::LogicTrace& pin : pins) {
    EXPECT_EQ(pin.edges().size(), drive.edges().size());
    for (std::size_t i = kind; i < std::min(pin.edges().size(), drive.edges().size()); i += 2) {
      sum += (pin.edges()[i] - drive.edges()[i]).value * 59e3;
      ++n;
    }
  }
  return sum / n;
}

std::vector<dsp::LogicTrace> waveform_pins(const ChainDesign& chain,
                                           const std::vector<EnvelopeInput>& trials) {
  std::vector<ChainInput> inputs;
  for (const EnvelopeInput& trial : trials)
    inputs.push_back({.drive = trial.drive,
                      .carrier_phase = trial.carrier_phase,
                      .noise_seed = trial.noise_seed});
  return propagate(chain, inputs);
}

// A step is a cycle; edges are met to a tenth of one, from weak light to strong, wherever in a step
// the integrator is full.
TEST(Envelope, EdgesAreThoseOfTheWaveform) {
  ModuleData module;
  module.agc_attack_db_per_ms = 0;
  for (const double integrator : {8.0, 7.1, 7.45, 11.25}) {
    module.integrator_cycles = integrator;
    for (const double mw_per_m2 : {0.4, 1.0, 10.0, 1000.0}) {
      const Chains chains(module, light_of(mw_per_m2, 0.3));
      const dsp::LogicTrace drive = train(40, dsp::Seconds(1.6713e-3));
      const auto inputs = trials(drive);
      const auto waveform = waveform_pins(chains.waveform, inputs);
      const auto envelope =
          propagate_envelopes(chains.envelope, inputs, whole(drive, chains.envelope));
      for (const std::size_t kind : {0u, 1u})
        EXPECT_NEAR(mean_delay(drive, envelope, kind), mean_delay(drive, waveform, kind), 0.1)
            << integrator << " cycles, " << mw_per_m2 << " mW/m2, "
            << (kind == 0 ? "light" : "dark");
    }
  }
}

// Without noise a dark stretch may be left out: the gain is what it would be, and so are edges.
TEST(Envelope, DarkThatIsLeftOutIsTheSameWithoutNoise) {
  const Chains chains(ModuleData{}, light_of(20, 0));
  dsp::LogicTrace drive = train(20, dsp::Seconds(1.7e-3));
  const dsp::Seconds later(drive.end() + dsp::Seconds(50e-3));
  for (int i = 0; i < 40; ++i) drive.add_edge(later + i * dsp::Seconds(1.7e-3));
  drive.observe_until(later + dsp::Seconds(90e-3));
  auto inputs = trials(drive);
  const auto all = propagate_envelopes(chains.envelope, inputs, whole(drive, chains.envelope));
  for (EnvelopeInput& input : inputs)
    input.begins = {dsp::Seconds(15e-3), later - dsp::Seconds(5e-3)};
  const std::vector<std::int32_t> steps{blocks_of(85e-3 * 59e3), blocks_of(90e-3 * 59e3)};
  const auto parts = propagate_envelopes(chains.envelope, inputs, steps);
  for (std::size_t lane = 0; lane < all.size(); ++lane) {
    ASSERT_EQ(parts[lane].edges().size(), all[lane].edges().size());
    EXPECT_GT(all[lane].edges().size(), 40u);
    for (std::size_t i = 0; i < all[lane].edges().size(); ++i)
      EXPECT_NEAR(parts[lane].edges()[i].value, all[lane].edges()[i].value, 0.05 / 59e3);
  }
}

// A stretch may take a minute.
TEST(Envelope, IsStoppedWithinAStretch) {
  const Chains chains(ModuleData{}, light_of(1));
  const EnvelopeStretch dark;
  const std::int32_t steps = 1000 * envelope_block;
  int asked = 0;
  EnvelopeKernelInput input;
  for (EnvelopeKernelInput::Lane& lane : input.lane) lane.stretches = &dark;
  input.design = &chains.envelope.unit.design;
  input.steps = &steps;
  input.n_stretches = 1;
  input.on_edge = [](void*, int, std::size_t, double) {};
  input.stopped = [](void* context) { return ++*static_cast<int*>(context) == 3; };
  input.context = &asked;
  run_envelopes_baseline(input);
  EXPECT_EQ(asked, 3);
}

/// Parts of a step that are lit, all times in 1/64 of one.
struct Lit64 {
  int end, begin;
};

/// Light that comes and goes, and as often as not without a gap between hold and next pulse.
Lit64 lit_part(std::mt19937& draw, bool light) {
  const int end = static_cast<int>(draw() % 65);
  if (!light) return {end / 8, 64};
  return {end, draw() % 2 == 0 ? end : std::min(64, end + static_cast<int>(draw() % 16))};
}

// An integrator that counts 64 times a step is the same to the last bit, as all times are 64ths.
TEST(Envelope, IntegratorSwitchesWhereAFineSteppedOneDoes) {
  std::mt19937 draw(1);
  for (const int top : {128, 150, 512}) {
    EnvelopeIntegrator<float> integrator(static_cast<float>(top) / 64);
    int level = 0, edges = 0;
    bool light = false, on = false;
    for (int step = 0; step < 20000; ++step) {
      if (draw() % 16 == 0) light = !light;
      const Lit64 lit = lit_part(draw, light);
      const bool before = on;
      int edge = 0;
      for (int i = 0; i < 64; ++i) {
        const bool was = on;
        level = std::clamp(level + (i < lit.end || i >= lit.begin ? 1 : -1), 0, top);
        on = level == top || (on && level > 0);
        if (on != was) edge = i + 1;
      }
      ASSERT_EQ(integrator({static_cast<float>(lit.end) / 64, static_cast<float>(lit.begin) / 64}),
                on);
      if (on == before) continue;
      ++edges;
      EXPECT_EQ(integrator.edge() * 64, static_cast<float>(edge)) << lit.end << ' ' << lit.begin;
    }
    EXPECT_GT(edges, 100);
  }
}

// Noise behind the band-pass has the waveform's deviation: sqrt(2 N B).
TEST(Envelope, NoiseIsThatOfTheBandPass) {
  const Chains chains(ModuleData{}, light_of(1));
  const EnvelopeNoise<float>& noise = chains.envelope.unit.design.resting;
  const double power = std::pow(static_cast<double>(noise.re), 2) +
                       std::pow(static_cast<double>(noise.cross), 2) +
                       std::pow(static_cast<double>(noise.im), 2);
  const double deviation = static_cast<double>(chains.waveform.noise_dark) *
                           std::sqrt(2 * noise_bandwidth(ModuleData{}).value / rate.value);
  EXPECT_NEAR(std::sqrt(power / 2) / deviation, 1, 5e-3);
  EXPECT_NEAR(noise_deviation(ModuleData{}, chains.waveform) / deviation, 1, 1e-6);
}

/// Variance of the output of a waveform's front end and band-pass in white samples of variance 1,
/// on average over the places where its comparator looks.
double looked_at_variance(const ModuleDesign& module) {
  const BandPassDesign& d = module.band_pass;
  const auto after = [](const BandPassStep<float>& step, double u, double v, double x) {
    return static_cast<double>(step.u) * u + static_cast<double>(step.v) * v +
           static_cast<double>(step.x) * x;
  };
  double x = static_cast<double>(module.front_end), u = 0, v = 0, sum = 0;
  for (int sample = 0; sample < 5000; ++sample) {
    const double third = after(d.third, u, v, x), two_thirds = after(d.two_thirds, u, v, x);
    const double integral = after(d.integral, u, v, x);
    u = after(d.output, u, v, x);
    v = integral;
    sum += (third * third + two_thirds * two_thirds + u * u) / 3;
    x *= 1 - static_cast<double>(module.front_end);
  }
  return sum;
}

// Of a step's noise a peak sees what the front end leaves of the waveform's.
TEST(Envelope, PeaksSeeTheNoiseThatTheFrontEndLeaves) {
  for (const double q : {7.0, 10.0, 30.0})
    for (const double front_end_hz : {40e3, 70e3, 150e3, 200e3}) {
      ModuleData module;
      module.q = q;
      module.front_end_hz = front_end_hz;
      const Chains chains(module, light_of(1));
      const double white = 2 * noise_bandwidth(module).value / rate.value;
      const EnvelopeDesign& d = chains.envelope.unit.design;
      const double kept =
          std::hypot(static_cast<double>(d.keep_re), static_cast<double>(d.keep_im));
      const double seen = static_cast<double>(d.seen);
      EXPECT_NEAR(1 - (1 - kept * kept) * (1 - seen * seen),
                  looked_at_variance(chains.waveform.module) / white, 1e-3)
          << "Q = " << q << ", " << front_end_hz << " Hz";
    }
}

}  // namespace
}  // namespace channel
