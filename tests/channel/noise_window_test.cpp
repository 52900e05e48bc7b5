// Noise that is prescribed and margins that are asked for: the same alone, among other trials and
// for all instruction sets, and nothing else is changed.
#include "channel/noise_window.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>
#include <vector>

#include "channel/chain.hpp"
#include "channel/normals.hpp"
#include "gtest/gtest.h"

namespace channel {
namespace {

constexpr std::int64_t first = 700, n = 3000;

/// A burst of 3 ms, for a module at the edge of hearing it.
struct Scene {
  ChainDesign chain = design_chain({},
                                   {.signal = dsp::WattsPerSquareMetre(0.12e-3),
                                    .ambient = dsp::WattsPerSquareMetre(1),
                                    .carrier = dsp::Hertz(59e3)},
                                   dsp::Hertz(600e3));
  dsp::LogicTrace drive{true};
  std::vector<float> normals = draw_normals({{{1, 2, 3, 4}, {5, 6, 7, 8}}}, n);
  std::vector<float> margins = std::vector<float>(n, 0.0f);
  NoiseWindow noise{first, n, normals.data()};
  MarginWindow margin{first, n, margins.data()};

  Scene() {
    drive.add_edge(dsp::Seconds(1.5e-3));
    drive.add_edge(dsp::Seconds(4.5e-3));
    drive.observe_until(dsp::Seconds(8e-3));
  }
  ChainInput input(std::uint32_t seed) {
    return {.drive = &drive,
            .carrier_phase = 0,
            .noise_seed = {seed, 1, 1, 1},
            .noise_windows = {&noise, 1},
            .margin_windows = {&margin, 1}};
  }
};

TEST(NoiseWindow, TakesThePlaceOfTheTrialsOwn) {
  Scene scene;
  Recording one, other;
  propagate_alone(scene.chain, scene.input(1), &one);
  propagate_alone(scene.chain, scene.input(2), &other);
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(one.irradiance.size()); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const bool within = i >= first && i < first + n;
    EXPECT_EQ(one.irradiance[at] == other.irradiance[at], within) << i;
  }
}

TEST(MarginWindow, IsTheSameForAllWaysToRun) {
  Scene scene;
  const std::vector<ChainInput> inputs{scene.input(1)};
  const auto pin = propagate_alone(scene.chain, inputs[0]);
  const std::vector<float> alone = scene.margins;
  EXPECT_GT(*std::max_element(alone.begin(), alone.end()), 0.0f);
  EXPECT_LT(*std::min_element(alone.begin(), alone.end()), 0.0f);
  for (const InstructionSet set :
       {InstructionSet::best, InstructionSet::v3, InstructionSet::baseline}) {
    scene.margins.assign(n, 0.0f);
    EXPECT_EQ(propagate(scene.chain, inputs, nullptr, set).front(), pin);
    EXPECT_EQ(scene.margins, alone);
  }
}

/// A trial with noise and margins of its own, from its own sample on.
struct Own {
  std::vector<float> normals, margins;
  NoiseWindow noise;
  MarginWindow margin;
  ChainInput input;

  Own(const Scene& scene, std::uint32_t i)
      : normals(draw_normals({{{i, 2, 3, 4}, {5, i, 7, 8}}}, n)),
        margins(n, 0.0f),
        noise{first + 37 * i, n, normals.data()},
        margin{first - 11 * i, n, margins.data()},
        input{.drive = &scene.drive,
              .carrier_phase = i << 20,
              .noise_seed = {i, 1, 1, 1},
              .noise_windows = {&noise, 1},
              .margin_windows = {&margin, 1}} {}
  Own(const Own&) = delete;
};

// Nineteen are more than any kernel has lanes for.
TEST(MarginWindow, OfEachTrialIsItsOwn) {
  const Scene scene;
  std::deque<Own> own;
  for (std::uint32_t i = 0; i < 19; ++i) own.emplace_back(scene, i + 1);
  std::vector<ChainInput> inputs;
  std::vector<dsp::LogicTrace> pins;
  std::vector<std::vector<float>> margins;
  for (Own& trial : own) {
    inputs.push_back(trial.input);
    pins.push_back(propagate_alone(scene.chain, trial.input));
    margins.push_back(trial.margins);
  }
  for (const InstructionSet set :
       {InstructionSet::best, InstructionSet::v3, InstructionSet::baseline}) {
    for (Own& trial : own) std::ranges::fill(trial.margins, 0.0f);
    EXPECT_EQ(propagate(scene.chain, inputs, nullptr, set), pins);
    for (std::size_t i = 0; i < own.size(); ++i) EXPECT_EQ(own[i].margins, margins[i]) << i;
  }
}

TEST(MarginWindow, ChangesNoPin) {
  Scene scene;
  ChainInput without = scene.input(3);
  without.margin_windows = {};
  EXPECT_EQ(propagate(scene.chain, std::vector{scene.input(3)}).front(),
            propagate(scene.chain, std::vector{without}).front());
}

TEST(Normals, AreTheSameForAllInstructionSets) {
  const StreamSeeds seeds{{{1, 2, 3, 4}, {9, 8, 7, 6}}};
  const std::vector<float> normals = draw_normals(seeds, 100001);
  EXPECT_EQ(normals, draw_normals(seeds, 100001, InstructionSet::v3));
  EXPECT_EQ(normals, draw_normals(seeds, 100001, InstructionSet::baseline));
  ASSERT_GE(normals.size(), 100001u);
  const double size = static_cast<double>(normals.size());
  const double squares = std::inner_product(normals.begin(), normals.end(), normals.begin(), 0.0);
  EXPECT_NEAR(std::accumulate(normals.begin(), normals.end(), 0.0) / size, 0, 4 / std::sqrt(size));
  EXPECT_NEAR(squares / size, 1, 4 * std::sqrt(2 / size));
}

}  // namespace
}  // namespace channel
