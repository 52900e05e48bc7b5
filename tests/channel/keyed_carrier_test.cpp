// The sampled light: energy, spectrum and edges must be those of the continuous wave, wherever the
// edges fall between the samples.
#include "channel/keyed_carrier.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include "gtest/gtest.h"

namespace channel {
namespace {

using std::numbers::pi;

CarrierDesign design(double cycles_a_sample, double duty = 0.5) {
  return {.step = static_cast<std::uint32_t>(std::llround(cycles_a_sample * 0x1p32)),
          .cycles = static_cast<float>(cycles_a_sample),
          .duty = static_cast<float>(duty),
          .amplitude = static_cast<float>(1 / cycles_a_sample)};
}

std::vector<float> sampled(const CarrierDesign& d, std::span<const Burst> bursts,
                           std::uint32_t phase, int n) {
  KeyedCarrier<float> carrier(d);
  carrier.load(0, bursts, phase);
  std::vector<float> samples;
  while (static_cast<int>(samples.size()) < n) {
    const int done = static_cast<int>(samples.size());
    const int length = carrier.begin_block(done, std::min(64, n - done));
    for (int i = 0; i < length; ++i) samples.push_back(carrier(i).irradiance);
  }
  return samples;
}

/// The continuous wave: light at time t (in samples).
bool lit(double t, std::span<const Burst> bursts, double cycles, double duty, double phase) {
  for (const Burst& b : bursts) {
    if (t < b.on || t >= b.off) continue;
    const double cycle = t * cycles + phase;
    return cycle - std::floor(cycle) < duty;
  }
  return false;
}

/// Each sample is the mean of the continuous wave over its interval, against brute force.
TEST(KeyedCarrier, SampleIsTheMeanOverItsInterval) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0, 1);
  for (int round = 0; round < 20; ++round) {
    const double cycles = 0.02 + 0.2 * u(random), duty = 0.2 + 0.6 * u(random);
    const double start = edge_at(3 + 5 * u(random)), second = edge_at(start + 30 + 10 * u(random));
    const std::vector<Burst> bursts = {{start, edge_at(start + 25 + u(random))},
                                       {second, edge_at(second + 20.4)}};
    const auto phase = static_cast<std::uint32_t>(random());
    const auto samples = sampled(design(cycles, duty), bursts, phase, 80);
    constexpr int fine = 4000;
    for (int n = 0; n < 80; ++n) {
      double mean = 0;
      for (int k = 0; k < fine; ++k)
        mean += lit(n + (k + 0.5) / fine, bursts, cycles, duty, phase * 0x1p-32) / double{fine};
      ASSERT_NEAR(samples[static_cast<std::size_t>(n)], mean, 2e-3) << round << " " << n;
    }
  }
}

/// Total light of a burst is its length times the duty, wherever its edges fall.
TEST(KeyedCarrier, EnergyDoesNotDependOnTheGrid) {
  const auto d = design(0.0590001);
  for (int i = 0; i < 50; ++i) {
    const double on = 10 + i * 0.173;
    const Burst burst{on, on + 100 / 0.0590001};  // 100 whole cycles
    double sum = 0;
    for (const float x : sampled(d, {&burst, 1}, static_cast<std::uint32_t>(i) * 77777777u, 1800))
      sum += static_cast<double>(x);
    EXPECT_NEAR(sum, 50 / 0.0590001, 0.05) << i;
  }
}

double line(std::span<const float> x, double cycles) {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += static_cast<double>(x[i]) * std::polar(1.0, -2 * pi * cycles * static_cast<double>(i));
  return 2 * std::abs(sum) / static_cast<double>(x.size());
}

// Fundamental of an on/off wave: (2/pi) sin(pi D), times the sinc of the mean over a sample.
// Fundamental of an on/off wave, (2/pi) sin(pi D): D = 1/2 .637, 1/3 .551, .25 .450.
TEST(KeyedCarrier, FundamentalOfTheDutyCycle) {
  const Burst always{0, 1e6};
  for (const auto& [duty, expected] : {std::pair{.5, .637}, {1 / 3., .551}, {.25, .450}}) {
    const double cycles = 0.0590007;
    const auto x = sampled(design(cycles, duty), {&always, 1}, 12345, 200000);
    const double droop = std::sin(pi * cycles) / (pi * cycles);
    EXPECT_NEAR(line(x, cycles) / droop, expected, 0.001) << duty;
  }
}

// A harmonic that folds onto the carrier is what an edge-sampled square wave suffers from: at 8
// samples a cycle exactly, the 7th and the 9th fall on the 1st. The mean over each sample weakens
// them to 2.1 % and 1.2 % ((1/7) sinc(7/8) / sinc(1/8) ...); sampled at points they would be 14 %
// and 11 %. Away from whole ratios nothing folds onto the carrier at all.
TEST(KeyedCarrier, FoldedHarmonicsAreWeak) {
  const Burst always{0, 1e6};
  double least = 1, most = 0;
  for (std::uint32_t i = 0; i < 32; ++i) {
    const auto x = sampled(design(0.125), {&always, 1}, i << 24, 8000);
    least = std::min(least, line(x, 0.125));
    most = std::max(most, line(x, 0.125));
  }
  EXPECT_LT(most / least, 1.09);
}

/// Steady stretches of a block, and the samples with an edge between them.
template <class Edge, class Stretch>
void walk(const KeyedCarrier<float>& carrier, int length, Stretch stretch, Edge edge) {
  for (int i = 0; i < length; ++i) {
    const int next = carrier.next_edge(i, length);
    for (; i < next; ++i) stretch(i);
    if (i < length) edge(i);
  }
}

TEST(KeyedCarrier, SteadyStretchesAreTheSamplesBetweenTheEdges) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0, 64);
  int edges = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const double a = edge_at(u(random) - 16);  // begun before the block, too
    const Burst burst{a, edge_at(a + 1 + u(random))};
    const CarrierDesign d = design(0.0983, 0.3);
    KeyedCarrier<float> steady(d);
    steady.load(0, {&burst, 1}, static_cast<std::uint32_t>(random()));
    const int length = steady.begin_block(0, 64);
    KeyedCarrier<float> general = steady;
    const auto same = [&](int i, float irradiance) {
      const auto sample = general(i);
      ASSERT_EQ(dsp::to_bits(irradiance), dsp::to_bits(sample.irradiance)) << trial << " " << i;
      ASSERT_TRUE(i == std::floor(burst.on) || i == std::floor(burst.off) ||
                  sample.lit == steady.lit_at(i));
    };
    walk(
        steady, length, [&](int i) { same(i, steady.steady(steady.lit_at(i))); },
        [&](int i) {
          same(i, steady(i).irradiance);
          ++edges;
        });
  }
  EXPECT_GT(edges, 500);
  EXPECT_LT(edges, 1000);
}

TEST(KeyedCarrier, LanesAreIndependentAndEqualToFloat) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0, 1);
  const auto d = design(0.0613);
  std::vector<std::vector<Burst>> bursts(8);
  KeyedCarrier<dsp::Lanes8> eight(d);
  std::vector<std::vector<float>> one;
  constexpr int n = 5000;
  for (int i = 0; i < 8; ++i) {
    double t = 20 * u(random);
    while (t < n) {
      const double off = t + 30 + 300 * u(random);
      bursts[static_cast<std::size_t>(i)].push_back({edge_at(t), edge_at(off)});
      t = off + 20 + 300 * u(random);
    }
    const auto phase = static_cast<std::uint32_t>(random());
    eight.load(i, bursts[static_cast<std::size_t>(i)], phase);
    one.push_back(sampled(d, bursts[static_cast<std::size_t>(i)], phase, n));
  }
  for (int at = 0; at < n;) {
    const int length = eight.begin_block(at, std::min(64, n - at));
    for (int k = 0; k < length; ++k, ++at) {
      const auto x = eight(k).irradiance;
      for (int i = 0; i < 8; ++i)
        ASSERT_EQ(dsp::lane(x, i), one[static_cast<std::size_t>(i)][static_cast<std::size_t>(at)])
            << i << " " << at;
    }
  }
}

}  // namespace
}  // namespace channel
