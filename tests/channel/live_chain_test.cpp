// Chains that go on while their LEDs are being keyed have the pins of chains that knew it all
// along.
#include "channel/live_chain.hpp"

#include <random>
#include <vector>

#include "channel/disturbance.hpp"
#include "gtest/gtest.h"

namespace channel {
namespace {

constexpr dsp::Hertz rate(600e3);
constexpr double length_s = 0.6;

/// Bursts of light in [from, to), some of them a single carrier cycle long.
dsp::LogicTrace random_drive(std::mt19937& random, double from, double to) {
  dsp::LogicTrace drive(true);
  std::uniform_real_distribution<double> u(2e-5, 6e-3);
  for (double at = from + u(random); at + 6e-3 < to; at += u(random)) {
    drive.set_at(dsp::Seconds(at), false);
    at += u(random);
    drive.set_at(dsp::Seconds(at), true);
  }
  return drive;
}

/// A link with another keyed light, and lamps of both other kinds.
ChainDesign design() {
  ChainDesign chain = design_chain(ModuleData{},
                                   {.signal = dsp::WattsPerSquareMetre(1e-3),
                                    .ambient = dsp::WattsPerSquareMetre(1),
                                    .carrier = dsp::Hertz(59e3)},
                                   rate);
  chain.disturbances.push_back(
      design_pwm(dsp::WattsPerSquareMetre(2e-4), dsp::Hertz(1000), 0.5, rate));
  chain.disturbances.push_back(
      design_keyed_light(dsp::WattsPerSquareMetre(8e-4), dsp::Hertz(59.5e3), 0.5, rate));
  chain.disturbances.push_back(design_fluorescent({.mean = dsp::WattsPerSquareMetre(1e-3)}, rate));
  return chain;
}

void append(dsp::LogicTrace& whole, const dsp::LogicTrace& part) {
  for (const dsp::Seconds edge : part.edges()) whole.add_edge(edge);
}

/// What is keyed on one chain, stretch by stretch.
struct Script {
  std::vector<dsp::LogicTrace> own, other;
};

constexpr int stretches = 12;

Script random_script(std::mt19937& random) {
  Script script;
  for (int i = 0; i < stretches; ++i) {
    const double from = i * length_s / stretches, to = (i + 1) * length_s / stretches;
    script.own.push_back(random_drive(random, from, to));
    script.other.push_back(random_drive(random, from, to));
  }
  return script;
}

ChainInput input(std::uint32_t seed, const dsp::LogicTrace* drive, dsp::LogicTrace other) {
  return {.drive = drive,
          .carrier_phase = seed * 77777U,
          .noise_seed = {seed, 2, 3, 4},
          .disturbances = {{.phase = {seed, 1}, .drive = dsp::LogicTrace(true)},
                           {.phase = {seed * 31U, 0}, .drive = std::move(other)},
                           {.phase = {5, seed}, .drive = dsp::LogicTrace(true)}}};
}

void expect_same_pins(InstructionSet set, std::size_t n) {
  std::mt19937 random(7);
  const ChainDesign chain = design();
  std::vector<Script> scripts;
  for (std::size_t i = 0; i < n; ++i) scripts.push_back(random_script(random));
  std::vector<ChainInput> empty, whole;
  std::vector<dsp::LogicTrace> drives(n, dsp::LogicTrace(true));
  for (std::size_t i = 0; i < n; ++i) {
    dsp::LogicTrace other(true);
    for (int k = 0; k < stretches; ++k) {
      append(drives[i], scripts[i].own[static_cast<std::size_t>(k)]);
      append(other, scripts[i].other[static_cast<std::size_t>(k)]);
    }
    drives[i].observe_until(dsp::Seconds(length_s));
    const auto seed = static_cast<std::uint32_t>(i + 1);
    whole.push_back(input(seed, &drives[i], other));
    empty.push_back(input(seed, nullptr, dsp::LogicTrace(true)));
  }
  LiveChains live(chain, empty, set);
  for (std::size_t k = 0; k < stretches; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      live.key(i, scripts[i].own[k]);
      live.key_disturbance(i, 1, scripts[i].other[k]);
    }
    live.advance(dsp::Seconds(static_cast<double>(k + 1) * length_s / stretches));
  }
  const auto pins = propagate(chain, whole, nullptr, InstructionSet::baseline);
  for (std::size_t i = 0; i < n; ++i) {
    const auto now = live.pin(i).edges(), then = pins[i].edges();
    ASSERT_GT(now.size(), 20U) << "something was heard";
    ASSERT_LE(now.size(), then.size());
    for (std::size_t f = 0; f < now.size(); ++f) ASSERT_EQ(now[f], then[f]) << i << " " << f;
    for (std::size_t f = now.size(); f < then.size(); ++f)
      ASSERT_GT(then[f], live.pin(i).end())
          << "only what is behind the last whole block is missing";
    ASSERT_NEAR(live.pin(i).end().value, length_s, 256 / rate.value);
  }
}

TEST(LiveChains, HaveThePinsOfChainsThatKnewItAll) {
  expect_same_pins(InstructionSet::baseline, 1);
  expect_same_pins(InstructionSet::baseline, 5);
  expect_same_pins(InstructionSet::v3, 8);
  expect_same_pins(InstructionSet::best,
                   static_cast<std::size_t>(trials_at_once(InstructionSet::best)));
}

TEST(LiveChains, GoNoFurtherThanTheyAreTold) {
  const ChainDesign chain = design();
  const std::vector<ChainInput> inputs{input(1, nullptr, dsp::LogicTrace(true))};
  LiveChains live(chain, inputs);
  live.advance(dsp::Seconds(0.01));
  EXPECT_LE(live.pin(0).end().value, 0.01);
  EXPECT_GT(live.pin(0).end().value, 0.01 - 256 / rate.value);
  const dsp::Seconds before = live.pin(0).end();
  live.advance(dsp::Seconds(0.005));  // nothing more to do
  EXPECT_EQ(live.pin(0).end(), before);
}

}  // namespace
}  // namespace channel
