// Decisions: eight trials at once are each the trial alone, to the last bit; leaving out noise that
// cannot matter changes nothing; light and dark have the noise of their own.
#include "channel/decision.hpp"

#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>

#include "dsp/normal.hpp"
#include "gtest/gtest.h"

namespace channel {
namespace {

using Statistic = IdealDesign::Statistic;

std::vector<bool> random_levels(std::size_t n) {
  std::mt19937 random(7);
  std::vector<bool> levels;
  for (std::size_t i = 0; i < n; ++i) levels.push_back(random() % 2 == 0);
  return levels;
}

IdealDesign receiver(Statistic statistic, double threshold) {
  return {statistic, threshold, dsp::Seconds(1 / 600.0)};
}

NoiseSeed seed(std::uint32_t i) { return {i, 2 * i + 1, i ^ 0x5a5a5a5au, 77}; }

struct Case {
  Statistic statistic;
  double amplitude, threshold, deviation_dark, deviation_lit;

  DecisionDesign design(const std::vector<bool>& levels) const {
    return design_decisions(receiver(statistic, threshold),
                            {amplitude, deviation_dark, deviation_lit}, levels);
  }
};

// Around and far from the threshold, on both sides of it, and light that is never heard as such.
const Case cases[] = {
    {Statistic::in_phase, 2, 1, 1, 1},    {Statistic::in_phase, 6, 3, 1, 1},
    {Statistic::in_phase, 6, 2, .7, 1.3}, {Statistic::in_phase, 1, 3, 1, 1},
    {Statistic::in_phase, 0, 0, 1, 1},    {Statistic::envelope, 2, 1.7, 1, 1},
    {Statistic::envelope, 6, 3.3, 1, 1},  {Statistic::envelope, 6, 2, .7, 1.3},
    {Statistic::envelope, 1, 3, 1, 1},    {Statistic::envelope, 0, 1.4, 1, 1},
};

TEST(DecisionDeterminism, EightTogetherAreEachAlone) {
  const auto levels = random_levels(510);
  std::vector<NoiseSeed> seeds;
  for (std::uint32_t i = 0; i < 8; ++i) seeds.push_back(seed(i));
  for (const Case& each : cases) {
    const DecisionDesign design = each.design(levels);
    const WrongBits together = decide(design, seeds);
    EXPECT_EQ(decide(design, seeds, InstructionSet::baseline), together);
    const WrongBits some = decide(design, std::span(seeds).subspan(2, 3));
    for (std::size_t lane = 0; lane < 8; ++lane) {
      const WrongBits alone = decide_alone(design, seeds[lane]);
      for (std::size_t bit = 0; bit < levels.size(); ++bit) {
        ASSERT_EQ(together[bit] >> lane & 1, alone[bit] & 1) << "lane " << lane << " bit " << bit;
      }
    }
    for (std::size_t bit = 0; bit < levels.size(); ++bit)
      ASSERT_EQ(some[bit] >> 1 & 1, together[bit] >> 3 & 1) << "neighbours must not matter";
  }
}

/// The same from every normal in full, in double precision.
bool is_wrong(const Case& each, bool dark, double x, double y) {
  const double deviation = dark ? each.deviation_dark : each.deviation_lit;
  const double in_phase = (dark ? 0 : each.amplitude) + deviation * x;
  const double measured =
      each.statistic == Statistic::in_phase ? in_phase : std::hypot(in_phase, deviation * y);
  return (measured > each.threshold) == dark;
}

TEST(Decision, NoiseThatIsLeftOutDoesNotMatter) {
  const auto levels = random_levels(2000);
  for (const Case& each : cases) {
    const DecisionDesign design = each.design(levels);
    for (std::uint32_t trial = 0; trial < 20; ++trial) {
      const WrongBits wrong = decide_alone(design, seed(trial));
      dsp::NormalSource<float> noise;
      noise.seed(0, seed(trial));
      float x = 0, y = 0;
      for (std::size_t bit = 0; bit < levels.size(); ++bit) {
        if (each.statistic == Statistic::envelope || bit % 2 == 0)
          std::tie(x, y) = noise();
        else
          x = y;
        ASSERT_EQ((wrong[bit] & 1) != 0, is_wrong(each, levels[bit], double{x}, double{y}))
            << "bit " << bit;
      }
    }
  }
}

/// Share of wrong bits where all bits are alike.
double wrong_share(const Case& each, bool dark) {
  const DecisionDesign design = each.design(std::vector<bool>(10000, dark));
  int wrong = 0;
  for (std::uint32_t first = 0; first < 160; first += 8) {
    std::vector<NoiseSeed> seeds;
    for (std::uint32_t i = 0; i < 8; ++i) seeds.push_back(seed(first + i));
    for (const std::uint8_t lanes : decide(design, seeds)) wrong += std::popcount(lanes);
  }
  return wrong / 1.6e6;
}

double q(double x) { return std::erfc(x / std::sqrt(2.0)) / 2; }

TEST(Decision, LightAndDarkHaveTheirOwnNoise) {
  const Case coherent{Statistic::in_phase, 5, 2, 1, 1.5},
      envelope{Statistic::envelope, 5, 2, .8, 2};
  const double sigma4 = 4 / std::sqrt(1.6e6);
  const auto near = [&](double measured, double theory) {
    EXPECT_NEAR(measured, theory, sigma4 * std::sqrt(theory));
  };
  near(wrong_share(coherent, true), q(2));
  near(wrong_share(coherent, false), q(2));  // 3 / 1.5
  near(wrong_share(envelope, true), std::exp(-2 * 2 / (2 * .8 * .8)));
  EXPECT_GT(wrong_share(envelope, false), 0.02);
}

TEST(Decision, WithoutNoiseOnlyTheThresholdDecides) {
  const auto levels = random_levels(100);
  for (const Statistic statistic : {Statistic::in_phase, Statistic::envelope})
    for (const double threshold : {0.5e5, 1.5e5}) {
      const WrongBits wrong =
          decide_alone(Case{statistic, 1e5, threshold, 1e-13, 1e-13}.design(levels), seed(1));
      for (std::size_t bit = 0; bit < levels.size(); ++bit)
        EXPECT_EQ(wrong[bit] & 1, threshold > 1e5 && !levels[bit]);
    }
}

/// Share of the normals beyond `x` that NormalSource has: its radius has 2^30 values.
double reached(double x) {
  double share = 0;
  for (double odd = 1;; odd += 2) {
    const double radius = std::sqrt(-2 * std::log(odd * 0x1p-31));
    if (radius <= x) return share;
    share += std::acos(x / radius) / std::numbers::pi * 0x1p-30;
  }
}

TEST(Decision, NormalsReachFarEnoughFor15Decibels) {
  const auto distance = [](double db) { return std::sqrt(std::pow(10, db / 10)); };
  for (const double db : {12.0, 14.0, 15.0})
    EXPECT_NEAR(reached(distance(db)) / q(distance(db)), 1, 1e-3) << db;
  EXPECT_LT(reached(distance(16)) / q(distance(16)), 0.95) << "the end of what is documented";
}

// The fundamental and its deviation are those of the samples' correlation.
TEST(Decision, MeasuresWhatTheSamplesWouldGive) {
  const LightSettings light{.signal = dsp::WattsPerSquareMetre(2e-3),
                            .ambient = dsp::WattsPerSquareMetre(5),
                            .carrier = dsp::Hertz(59e3)};
  const ChainDesign chain = design_chain(ModuleData{}, light, dsp::Hertz(6e5));
  const CorrelatorOutput output = correlator_output(chain, light, dsp::Hertz(600));
  EXPECT_DOUBLE_EQ(output.amplitude, 2 * 2 / std::numbers::pi);
  EXPECT_DOUBLE_EQ(output.deviation_dark, double{chain.noise_dark} * std::sqrt(2 * 600 / 6e5));
  EXPECT_DOUBLE_EQ(output.deviation_lit, double{chain.noise_lit} * std::sqrt(2 * 600 / 6e5));
  EXPECT_GT(output.deviation_lit, output.deviation_dark)
      << "a module hears its signal's shot noise";
}

}  // namespace
}  // namespace channel
