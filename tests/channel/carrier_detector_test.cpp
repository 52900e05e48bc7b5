#include "channel/carrier_detector.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "channel/normals.hpp"
#include "dsp/philox.hpp"

namespace channel {
namespace {

std::vector<double> sampled_cosine(std::size_t n, double cycles, double phase, double offset = 0) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i)
    x[i] = offset + std::cos(2 * std::numbers::pi * (cycles * static_cast<double>(i) + phase));
  return x;
}

std::vector<double> noise(std::size_t n, std::uint32_t trial) {
  const dsp::RandomAddress draws{.seed = 5, .trial = trial};
  StreamSeeds seeds;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    seeds[i] = draws.block(static_cast<std::uint32_t>(i));
  const auto normals = draw_normals(seeds, n);
  return {normals.begin(), normals.begin() + static_cast<std::ptrdiff_t>(n)};
}

/// Share of windows of noise in which a statistic exceeds a threshold.
template <class Detector>
double exceeded(const Detector& detector, std::size_t n, double threshold) {
  constexpr std::uint32_t trials = 20000;
  int count = 0;
  for (std::uint32_t trial = 0; trial < trials; ++trial)
    count += detector(noise(n, trial)) > threshold;
  return static_cast<double>(count) / trials;
}

TEST(SynchronousDetector, GivesTheRootOfTheEnergyThatVaries) {
  const auto x = sampled_cosine(100, 0.05, 0.13, 7);  // whole cycles: energy of the cosine n / 2
  EXPECT_NEAR(SynchronousDetector(x)(x), std::sqrt(50), 1e-9);
}

TEST(SynchronousDetector, DoesNotSeeSteadyLight) {
  const auto x = sampled_cosine(97, 0.053, 0.1);
  EXPECT_NEAR(SynchronousDetector(x)(std::vector<double>(97, 3.0)), 0, 1e-12);
  EXPECT_TRUE(SynchronousDetector(std::vector<double>(97, 3.0)).blind());
  EXPECT_FALSE(SynchronousDetector(x).blind());
}

TEST(SynchronousDetector, IsStandardNormalInNoise) {
  const SynchronousDetector detector(sampled_cosine(23, 0.27, 0.3, 1));
  EXPECT_NEAR(exceeded(detector, 23, 1.0), 0.15866, 4 * std::sqrt(0.1587 * 0.8413 / 20000));
}

// Of a frequency that is no multiple of a bin, of one below a cycle a window, and of an alias.
constexpr std::array odd_frequencies{0.0731, 0.0271, 0.4913, 2.95};

TEST(GoertzelDetector, GivesTheEnergyOfAnyPhaseAndIgnoresTheMean) {
  for (const double f : odd_frequencies)
    for (const double phase : {0.0, 0.21, 0.77}) {
      const auto x = sampled_cosine(23, f, phase, 40);
      const double root = SynchronousDetector(x)(x);  // of the energy of what varies
      EXPECT_NEAR(GoertzelDetector(f, 23)(x), root * root, 1e-7) << f << " " << phase;
    }
}

TEST(GoertzelDetector, IsChiSquareOfTwoInNoise) {
  const double threshold = -2 * std::log(0.1);  // exceeded with probability .1
  for (const double f : odd_frequencies)
    EXPECT_NEAR(exceeded(GoertzelDetector(f, 23), 23, threshold), 0.1,
                4 * std::sqrt(0.1 * 0.9 / 20000))
        << f;
}

TEST(GoertzelDetector, IsBlindWhereTheAliasHasNoPhase) {
  EXPECT_TRUE(GoertzelDetector(3, 50).blind());
  EXPECT_TRUE(GoertzelDetector(2.5, 50).blind());
  EXPECT_FALSE(GoertzelDetector(2.49, 50).blind());
}

TEST(DcDifference, IsInDeviationsOfTheDifferenceOfMeans) {
  const std::vector<double> light(4, 3.0), reference(12, 1.0);
  EXPECT_NEAR(dc_difference(light, reference), 2 / std::sqrt(1.0 / 4 + 1.0 / 12), 1e-12);
}

}  // namespace
}  // namespace channel
