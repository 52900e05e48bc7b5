// Light whose gain changes along a way: it follows its knots, a gain of one is none at all, and
// trials at once are each the trial alone.
#include <algorithm>
#include <cmath>
#include <random>

#include "channel/chain.hpp"
#include "gtest/gtest.h"

namespace channel {
namespace {

constexpr dsp::Hertz rate(600e3);
constexpr int knots = 40;

std::vector<float> random_gain(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> u(0, 1);
  std::vector<float> gain(knots);
  for (float& g : gain) g = u(random);
  return gain;
}

ChainDesign dark_design(double noise_scale) {
  return design_chain(ModuleData{},
                      {.signal = {},
                       .ambient = dsp::WattsPerSquareMetre(1),
                       .carrier = dsp::Hertz(59e3),
                       .noise_scale = noise_scale},
                      rate);
}

Disturbance keyed(double carrier_hz, std::vector<float> gain) {
  Disturbance light =
      design_keyed_light(dsp::WattsPerSquareMetre(2e-3), dsp::Hertz(carrier_hz), 0.5, rate);
  light.gain = std::move(gain);
  return light;
}

/// As long as the gain has knots for, but for the last stretch.
dsp::Seconds length() { return dsp::Seconds((knots - 2) * gain_step / rate.value); }

dsp::LogicTrace random_drive(std::mt19937& random) {
  dsp::LogicTrace drive(true);
  std::uniform_real_distribution<double> u(2e-4, 8e-3);
  for (double at = -u(random); at < length().value; at += u(random))
    drive.add_edge(dsp::Seconds(at));
  return drive;
}

Recording recorded(const ChainDesign& design, const dsp::LogicTrace& drive,
                   dsp::LogicTrace* pin = nullptr) {
  const dsp::LogicTrace dark(true, length());
  Recording taps;
  const auto heard = propagate_alone(
      design, {&dark, 0, {5, 6, 7, 8}, nullptr, {{.phase = {77, 0}, .drive = drive}}}, &taps);
  if (pin != nullptr) *pin = heard;
  return taps;
}

double gain_at(const std::vector<float>& gain, std::size_t sample) {
  const double place = static_cast<double>(sample) / gain_step;
  const auto i = static_cast<std::size_t>(place);
  return std::lerp(gain[i], gain[i + 1], place - static_cast<double>(i));
}

TEST(GainRamp, LightFollowsItsKnotsInStraightLines) {
  std::mt19937 random(3);
  const auto gain = random_gain(1);
  const auto drive = random_drive(random);
  ChainDesign ramped = dark_design(0), steady = dark_design(0);
  ramped.disturbances.push_back(keyed(59e3, gain));
  steady.disturbances.push_back(keyed(59e3, {}));
  const auto with = recorded(ramped, drive).irradiance,
             without = recorded(steady, drive).irradiance;
  ASSERT_EQ(with.size(), without.size());
  std::size_t lit = 0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    lit += without[i] > 0;
    ASSERT_NEAR(with[i], without[i] * gain_at(gain, i), 1e-5) << i;
  }
  EXPECT_GT(lit, with.size() / 8);
}

TEST(GainRamp, NoStepIsLargerThanTheSlope) {
  const auto gain = random_gain(2);
  float before = gain.front();
  for (std::int64_t first = 0; first < (knots - 1) * gain_step; first += 256) {
    const GainRamp<float> ramp(gain.data(), first);
    for (int i = 0; i < 256; ++i) {
      const float now = ramp(i);
      ASSERT_LE(std::fabs(now - before), 1.0 / gain_step + 1e-6) << first + i;
      before = now;
    }
  }
}

TEST(GainRamp, AGainOfOneIsNone) {
  std::mt19937 random(4);
  const auto drive = random_drive(random);
  ChainDesign one = dark_design(1), none = dark_design(1);
  one.disturbances.push_back(keyed(59e3, std::vector<float>(knots, 1.0f)));
  none.disturbances.push_back(keyed(59e3, {}));
  dsp::LogicTrace pin_of_one, pin_of_none;
  EXPECT_EQ(recorded(one, drive, &pin_of_one).irradiance,
            recorded(none, drive, &pin_of_none).irradiance);
  EXPECT_EQ(pin_of_one, pin_of_none);
  EXPECT_GT(pin_of_one.edges().size(), 10u);
}

TEST(GainRamp, LightsAddUp) {
  std::mt19937 random(5);
  const auto drive = random_drive(random);
  ChainDesign both = dark_design(0);
  std::vector<float> sum;
  for (const unsigned seed : {1u, 2u}) {
    ChainDesign one = dark_design(0);
    one.disturbances.push_back(keyed(59e3, random_gain(seed)));
    both.disturbances.push_back(one.disturbances.front());
    const auto light = recorded(one, drive).irradiance;
    sum.resize(light.size());
    std::ranges::transform(sum, light, sum.begin(), std::plus{});
  }
  const dsp::LogicTrace dark(true, length());
  const DisturbanceInput input{.phase = {77, 0}, .drive = drive};
  Recording taps;
  propagate_alone(both, {&dark, 0, {5, 6, 7, 8}, nullptr, {input, input}}, &taps);
  ASSERT_EQ(taps.irradiance.size(), sum.size());
  for (std::size_t i = 0; i < sum.size(); ++i) ASSERT_NEAR(taps.irradiance[i], sum[i], 1e-6) << i;
}

// Twenty are more than any kernel has lanes for.
TEST(GainRampDeterminism, ManyTogetherAreEachAlone) {
  std::mt19937 random(6);
  ChainDesign design = dark_design(1);
  for (const unsigned seed : {1u, 2u, 3u})
    design.disturbances.push_back(keyed(58e3 + 500 * seed, random_gain(seed)));
  design.disturbances.push_back(keyed(38e3, {}));
  const dsp::LogicTrace dark(true, length());
  std::vector<ChainInput> inputs;
  for (std::uint32_t i = 0; i < 20; ++i) {
    inputs.push_back({&dark, 0, {i, 1, 2, 3}});
    for (std::size_t k = 0; k < design.disturbances.size(); ++k)
      inputs.back().disturbances.push_back(
          {.phase = {static_cast<std::uint32_t>(random()), 0}, .drive = random_drive(random)});
  }
  const auto together = propagate(design, inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    EXPECT_GT(together[i].edges().size(), 10u);
    EXPECT_EQ(together[i], propagate_alone(design, inputs[i])) << "lane " << i;
  }
  for (const InstructionSet set : {InstructionSet::v3, InstructionSet::baseline})
    EXPECT_EQ(propagate(design, inputs, nullptr, set), together);
  const std::span<const ChainInput> all(inputs);
  EXPECT_EQ(propagate(design, all.subspan(2, 3))[1], together[3]) << "neighbours must not matter";
}

}  // namespace
}  // namespace channel
