#include "sim/counting/statistics.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <vector>

#include "sim/result/result.hpp"
#include "tally_words.hpp"

namespace {

using sim::CounterWords;
using sim::Tally;
using sim::tally_of;
using sim::words_of;

void add_frame(Tally& tally, std::uint64_t bits, std::uint64_t errors) {
  Tally frame;
  frame.n_frames = 1;
  frame.n_bits = bits;
  frame.n_bit_errors = errors;
  frame.n_frames_bit_errors = errors > 0;
  frame.sum_bits_squared = bits * bits;
  frame.sum_bit_errors_squared = errors * errors;
  frame.sum_bit_errors_times_bits = bits * errors;
  tally += frame;
}

struct Bursts {
  double p_bad_frame, p_bit_in_bad_frame;
  int frames = 300, bits = 170;
  double ber() const { return p_bad_frame * p_bit_in_bad_frame; }
};

Tally experiment(const Bursts& bursts, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform;
  Tally tally;
  for (int frame = 0; frame < bursts.frames; ++frame) {
    std::uint64_t errors = 0;
    if (uniform(random) < bursts.p_bad_frame) {
      for (int bit = 0; bit < bursts.bits; ++bit) {
        errors += uniform(random) < bursts.p_bit_in_bad_frame;
      }
    }
    add_frame(tally, static_cast<std::uint64_t>(bursts.bits), errors);
  }
  return tally;
}

struct MeanCoverage {
  double clustered = 0, plain = 0;
};

bool covers(sim::Interval ci, double truth) { return ci.low <= truth && truth <= ci.high; }

MeanCoverage mean_coverage(const Bursts& bursts) {
  constexpr int experiments = 8000;
  std::mt19937_64 random(20240517);
  MeanCoverage c;
  for (int i = 0; i < experiments; ++i) {
    const Tally t = experiment(bursts, random);
    const auto plain = sim::clopper_pearson(static_cast<double>(t.n_bit_errors),
                                            static_cast<double>(t.n_bits), 0.95);
    c.clustered += covers(sim::bit_error_interval(t, 0.95), bursts.ber()) / double{experiments};
    c.plain += covers(plain, bursts.ber()) / double{experiments};
  }
  return c;
}

TEST(ClopperPearson, AgreesWithMatlabBerconfint) {
  const auto ci = sim::clopper_pearson(100, 1e6, 0.95);
  EXPECT_NEAR(ci.low, 8.136471e-5, 5e-12);
  EXPECT_NEAR(ci.high, 1.216255e-4, 5e-11);
}

TEST(ClopperPearson, HasClosedFormsAtTheEnds) {
  for (const double n : {1.0, 10.0, 300.0, 1e6}) {
    const auto none = sim::clopper_pearson(0, n, 0.95);
    EXPECT_EQ(none.low, 0);
    EXPECT_NEAR(none.high, -std::expm1(std::log(0.025) / n), 1e-12);
    const auto all = sim::clopper_pearson(n, n, 0.95);
    EXPECT_NEAR(all.low, std::exp(std::log(0.025) / n), 1e-12);
    EXPECT_EQ(all.high, 1);
  }
}

TEST(ClopperPearson, LeavesHalfTheDoubtInEachTail) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    const int n = std::uniform_int_distribution(2, 60)(random);
    const int k = std::uniform_int_distribution(1, n - 1)(random);
    const auto ci = sim::clopper_pearson(k, n, 0.9);
    const auto probability = [&](int j, double p) {
      return std::exp(std::lgamma(n + 1.0) - std::lgamma(j + 1.0) - std::lgamma(n - j + 1.0) +
                      j * std::log(p) + (n - j) * std::log1p(-p));
    };
    double at_least = 0, at_most = 0;
    for (int j = k; j <= n; ++j) at_least += probability(j, ci.low);
    for (int j = 0; j <= k; ++j) at_most += probability(j, ci.high);
    EXPECT_NEAR(at_least, 0.05, 1e-9);
    EXPECT_NEAR(at_most, 0.05, 1e-9);
  }
}

// Garwood, Biometrika 28 (1936) 437-442; the 95 % limits as Ulm prints them, Am. J. Epidemiol. 131
// (1990) 373-375.
TEST(PoissonRate, HasGarwoodsLimits) {
  const struct {
    std::uint64_t events;
    double low, high;
  } limits[] = {{0, 0, 3.6889},       {1, 0.0253, 5.5716},   {2, 0.2422, 7.2247},
                {5, 1.6235, 11.6683}, {10, 4.7954, 18.3904}, {20, 12.2165, 30.8884}};
  for (const auto& [events, low, high] : limits) {
    const sim::Estimate rate = sim::poisson_rate(events, 4, 0.95);
    EXPECT_DOUBLE_EQ(rate.value, static_cast<double>(events) / 4);
    EXPECT_NEAR(rate.low * 4, low, 6e-5) << events;
    EXPECT_NEAR(rate.high * 4, high, 6e-5) << events;
  }
}

double poisson(std::uint64_t events, double mean) {
  const auto n = static_cast<double>(events);
  return std::exp(n * std::log(mean) - mean - std::lgamma(n + 1));
}

// Exact: it misses the truth in 5 % of all experiments at most, to either side in 2.5 %.
TEST(PoissonRate, MeasuredCoversTheTruthWhateverItIs) {
  for (double mean = 0.05; mean < 40; mean *= 1.07) {
    double too_low = 0, too_high = 0;
    for (std::uint64_t events = 0; events < 150; ++events) {
      const sim::Estimate rate = sim::poisson_rate(events, 1, 0.95);
      if (rate.high < mean) too_low += poisson(events, mean);
      if (rate.low > mean) too_high += poisson(events, mean);
    }
    EXPECT_LE(too_low, 0.025) << mean;
    EXPECT_LE(too_high, 0.025) << mean;
  }
}

TEST(PoissonRate, LeavesHalfTheDoubtInEachTail) {
  for (const std::uint64_t events : {1U, 3U, 12U, 60U}) {
    const sim::Estimate rate = sim::poisson_rate(events, 1, 0.9);
    double fewer = 0, at_most = 0;
    for (std::uint64_t n = 0; n < events; ++n) fewer += poisson(n, rate.low);
    for (std::uint64_t n = 0; n <= events; ++n) at_most += poisson(n, rate.high);
    EXPECT_NEAR(1 - fewer, 0.05, 1e-9);
    EXPECT_NEAR(at_most, 0.05, 1e-9);
  }
}

TEST(PoissonRate, KnowsNothingWithoutTime) {
  const sim::Estimate rate = sim::poisson_rate(0, 0, 0.95);
  EXPECT_TRUE(std::isnan(rate.value) && std::isnan(rate.low) && std::isnan(rate.high));
}

TEST(ClopperPearson, KnowsNothingWithoutTrials) {
  const auto ci = sim::clopper_pearson(0, 0, 0.95);
  EXPECT_EQ(ci.low, 0);
  EXPECT_EQ(ci.high, 1);
}

TEST(BitErrorInterval, MeasuredCoversTheTruthWhenBitsFailTogether) {
  const MeanCoverage c = mean_coverage({.p_bad_frame = 0.1, .p_bit_in_bad_frame = 0.2});
  EXPECT_GE(c.clustered, 0.935);
  EXPECT_LE(c.clustered, 0.98);
  EXPECT_LT(c.plain, 0.70);
}

// Six in the mean: exact intervals of so few are wide, and how long bursts are is not well known.
TEST(BitErrorInterval, MeasuredCoversTheTruthWhenBadFramesAreRare) {
  const MeanCoverage c = mean_coverage({.p_bad_frame = 0.02, .p_bit_in_bad_frame = 0.2});
  EXPECT_GE(c.clustered, 0.945);
  EXPECT_LE(c.clustered, 0.985);
  EXPECT_LT(c.plain, 0.70);
}

TEST(BitErrorInterval, IsClopperPearsonForIndependentBits) {
  std::mt19937_64 random(3);
  const Tally t =
      experiment({.p_bad_frame = 1, .p_bit_in_bad_frame = 0.05, .frames = 3000}, random);
  const auto clustered = sim::bit_error_interval(t, 0.95);
  const auto plain = sim::clopper_pearson(static_cast<double>(t.n_bit_errors),
                                          static_cast<double>(t.n_bits), 0.95);
  EXPECT_NEAR((clustered.high - clustered.low) / (plain.high - plain.low), 1, 0.05);
}

TEST(BitErrorInterval, IsNeverNarrowerThanClopperPearson) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 500; ++i) {
    const Bursts bursts{uniform(random), uniform(random) * uniform(random),
                        1 + static_cast<int>(uniform(random) * 40), 170};
    const Tally t = experiment(bursts, random);
    const auto clustered = sim::bit_error_interval(t, 0.95);
    const auto plain = sim::clopper_pearson(static_cast<double>(t.n_bit_errors),
                                            static_cast<double>(t.n_bits), 0.95);
    EXPECT_LE(clustered.low, plain.low + 1e-12);
    EXPECT_GE(clustered.high, plain.high - 1e-12);
  }
}

// By hand: ratio 0.2, variance 10 / 9 * 10 * 10^2 / 1000^2 = 1 / 900, so 0.2 * 0.8 * 900 = 144
// effective bits; Student's t at 9 and 999 degrees of freedom: 2.262157 and 1.962341.
TEST(BitErrorInterval, TrustsFewFramesLess) {
  Tally t;
  for (int i = 0; i < 5; ++i) {
    add_frame(t, 100, 10);
    add_frame(t, 100, 30);
  }
  const double effective = 144 * std::pow(1.962341 / 2.262157, 2);
  const auto expected = sim::clopper_pearson(0.2 * effective, effective, 0.95);
  EXPECT_NEAR(sim::bit_error_interval(t, 0.95).low, expected.low, 1e-6);
  EXPECT_NEAR(sim::bit_error_interval(t, 0.95).high, expected.high, 1e-6);
}

// Equal ratios in all frames leave no variance between them, which must not narrow anything.
TEST(BitErrorInterval, TakesEvenlySpreadErrorsForIndependentBits) {
  Tally t;
  for (int i = 0; i < 1000; ++i) add_frame(t, 100, 1);
  const auto plain = sim::clopper_pearson(1000, 100000, 0.95);
  const auto clustered = sim::bit_error_interval(t, 0.95);
  EXPECT_LE(clustered.low, plain.low);
  EXPECT_NEAR(clustered.high / plain.high, 1, 0.01);
}

// Nothing is known of bursts, but one frame of 200 was bad and one bit of it wrong: 1 -
// 0.975^(1/200) of the frames at least, by a bit of 170 each.
TEST(BitErrorInterval, OfOneBadFrameIsNotBelowItsOneBit) {
  Tally t;
  for (int i = 0; i < 200; ++i) add_frame(t, 170, i == 7 ? 5 : 0);
  EXPECT_NEAR(sim::bit_error_interval(t, 0.95).low, -std::expm1(std::log(0.975) / 200) / 170,
              1e-12);
}

TEST(BitErrorInterval, CountsFramesWhenNothingOrEverythingFailed) {
  Tally none, all;
  for (int i = 0; i < 50; ++i) add_frame(none, 170, 0);
  for (int i = 0; i < 50; ++i) add_frame(all, 170, 170);
  EXPECT_EQ(sim::bit_error_interval(none, 0.95).high, sim::clopper_pearson(0, 50, 0.95).high);
  EXPECT_EQ(sim::bit_error_interval(all, 0.95).low, sim::clopper_pearson(50, 50, 0.95).low);
}

TEST(Ratios, AreNotANumberWhereNothingWasCounted) {
  EXPECT_TRUE(std::isnan(sim::ratio(0, 0)));
  EXPECT_EQ(sim::ratio(1, 4), 0.25);
  for (const auto ratio :
       {sim::bit_error_ratio, sim::frame_loss_ratio, sim::undetected_error_ratio}) {
    const sim::Estimate e = ratio(Tally{}, 0.95);
    EXPECT_TRUE(std::isnan(e.value) && std::isnan(e.low) && std::isnan(e.high));
  }
}

TEST(Ratios, UseTheirOwnCounts) {
  Tally t;
  t.n_frames = 200;
  t.n_frames_lost = 10;
  t.n_frames_undetected = 4;
  EXPECT_EQ(sim::frame_loss_ratio(t, 0.95).value, 0.05);
  EXPECT_EQ(sim::frame_loss_ratio(t, 0.95).high, sim::clopper_pearson(10, 200, 0.95).high);
  EXPECT_EQ(sim::undetected_error_ratio(t, 0.95).value, 0.02);
  EXPECT_EQ(sim::undetected_error_ratio(t, 0.95).low, sim::clopper_pearson(4, 200, 0.95).low);
}

TEST(TallySum, AddsEveryCounter) {
  CounterWords a{}, b{};
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = i + 1;
    b[i] = 1000 * (i + 1);
  }
  Tally sum = tally_of(a);
  sum += tally_of(b);
  const auto words = words_of(sum);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(words[i], 1001 * (i + 1)) << i;
}

TEST(TallySum, AddsEveryWeightedSum) {
  sim::WeightWords a{}, b{};
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = static_cast<double>(i + 1);
    b[i] = static_cast<double>(1000 * (i + 1));
  }
  Tally sum{.weighted = std::bit_cast<sim::Weighted>(a)};
  sum += {.weighted = std::bit_cast<sim::Weighted>(b)};
  const auto words = std::bit_cast<sim::WeightWords>(sum.weighted);
  int largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest += words[i] == b[i];
    EXPECT_TRUE(words[i] == a[i] + b[i] || words[i] == b[i]) << i;
  }
  EXPECT_EQ(largest, 2);  // of bit errors and of frames lost
}

sim::LinkResult one_point() {
  sim::LinkResult result;
  result.axes = {{"receiver.range_m", "m", "distance", {2.5}}};
  CounterWords words{};
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = i;
  result.points = {{.coordinates = {2.5}, .tally = tally_of(words)}};
  return result;
}

TEST(Digest, DependsOnEveryCounterAndCoordinate) {
  const std::string digest = sim::result_digest(one_point());
  for (std::size_t i = 0; i < CounterWords{}.size(); ++i) {
    sim::LinkResult other = one_point();
    auto words = words_of(other.points[0].tally);
    words[i] ^= std::uint64_t{1} << 40;
    other.points[0].tally = tally_of(words);
    EXPECT_NE(sim::result_digest(other), digest) << i;
  }
  sim::LinkResult elsewhere = one_point();
  elsewhere.points[0].coordinates[0] = 2.6;
  EXPECT_NE(sim::result_digest(elsewhere), digest);
  sim::LinkResult longer = one_point();
  longer.points.push_back(longer.points[0]);
  EXPECT_NE(sim::result_digest(longer), digest);
}

TEST(Digest, DependsOnEveryWeightedSum) {
  sim::WeightWords sums{};
  sums.fill(1);
  sim::LinkResult weighted = one_point();
  weighted.points[0].tally.weighted = std::bit_cast<sim::Weighted>(sums);
  for (double& sum : sums) {
    sum = 2;
    sim::LinkResult other = weighted;
    other.points[0].tally.weighted = std::bit_cast<sim::Weighted>(sums);
    EXPECT_NE(sim::result_digest(other), sim::result_digest(weighted));
    sum = 1;
  }
}

TEST(Digest, DependsOnNothingElse) {
  sim::LinkResult other = one_point();
  other.title = other.command = other.scenario_toml = "other";
  other.seed = 99;
  other.points[0].elapsed_s = 3;
  other.points[0].n_samples = 7;
  other.points[0].stop = sim::StopReason::interrupted;
  other.points[0].operating.snr_db = 12;
  EXPECT_EQ(sim::result_digest(other), sim::result_digest(one_point()));
}

// A stored digest must mean the same for ever; if this changes, format_version must.
TEST(Digest, IsTheSameOnEveryMachineAndInEveryVersion) {
  EXPECT_EQ(sim::result_digest(one_point()), "ecfc6e3170ed46ca2b043a6af48fc025");
}

}  // namespace
