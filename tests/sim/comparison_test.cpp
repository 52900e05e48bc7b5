// Equal results are called equal, chance is not called a difference, and a difference is found.
#include "sim/result/comparison.hpp"

#include <random>

#include "program.hpp"

namespace {

// scipy.stats.fisher_exact (1.10) of [[3, 1], [1, 3]], [[3, 7], [8, 2]], [[0, 100], [8, 92]].
TEST(FisherExact, AgreesWithScipy) {
  EXPECT_NEAR(sim::fisher_exact(3, 4, 1, 4), 0.4857143, 1e-6);
  EXPECT_NEAR(sim::fisher_exact(3, 10, 8, 10), 0.06977851, 1e-6);
  EXPECT_NEAR(sim::fisher_exact(0, 100, 8, 100), 0.006754675, 1e-8);
}

TEST(FisherExact, EndsAndSymmetry) {
  EXPECT_EQ(sim::fisher_exact(0, 50, 0, 70), 1);
  EXPECT_EQ(sim::fisher_exact(50, 50, 70, 70), 1);
  EXPECT_NEAR(sim::fisher_exact(2, 30, 9, 40), sim::fisher_exact(9, 40, 2, 30), 1e-12);
  EXPECT_NEAR(sim::fisher_exact(2, 30, 9, 40), sim::fisher_exact(28, 30, 31, 40), 1e-9);
}

// Where the exact sum would be long the normal approximation takes over without a step.
TEST(FisherExact, GoesOnIntoTheNormalApproximation) {
  const double exact = sim::fisher_exact(10100, 1000000, 9800, 1000000);
  const double normal = sim::fisher_exact(10100, 1000001, 9800, 1000000);
  EXPECT_NEAR(normal / exact, 1, 0.05);
}

sim::LinkResult drawn(const std::vector<double>& losses, std::uint64_t frames,
                      std::mt19937_64& random) {
  sim::LinkResult result;
  for (const double loss : losses) {
    sim::LinkPoint p;
    p.tally.n_frames = frames;
    p.tally.n_frames_lost = std::binomial_distribution<std::uint64_t>(frames, loss)(random);
    result.points.push_back(p);
  }
  return result;
}

// Of 2000 pairs of equals, ten points each, at most 1 % may be called different.
TEST(Comparison, FalseAlarmsAreRare) {
  const std::vector<double> losses{0.001, 0.01, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1};
  std::mt19937_64 random(3);
  int alarms = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto a = drawn(losses, 300, random), b = drawn(losses, 300, random);
    alarms += sim::compare(a, b, 0.01).different() > 0;
  }
  EXPECT_LE(alarms, 20);
  EXPECT_GE(alarms, 1);  // nor is the test blunt
}

// Twice the loss at one point of ten is found nearly always.
TEST(Comparison, TwiceTheLossIsFound) {
  std::mt19937_64 random(4);
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    const auto a = drawn({0.1, 0.1, 0.1, 0.1, 0.1}, 1000, random);
    const auto b = drawn({0.1, 0.1, 0.2, 0.1, 0.1}, 1000, random);
    const auto comparison = sim::compare(a, b, 0.01);
    found += comparison.tests[2].different;
  }
  EXPECT_GE(found, 198);
}

/// Points of frames that are all lost, with this many wrong bits of 170 on average, in bursts.
sim::LinkResult lost(const std::vector<double>& errors, std::mt19937_64& random) {
  sim::LinkResult result;
  for (const double mean : errors) {
    sim::Tally tally{.n_frames = 100, .n_frames_lost = 100};
    for (int frame = 0; frame < 100; ++frame) {
      const std::uint64_t wrong =
          std::geometric_distribution<std::uint64_t>(1 / (1 + mean))(random);
      const std::uint64_t bits = 170;
      tally += {.n_bits = bits,
                .n_bit_errors = wrong,
                .n_frames_bit_errors = wrong > 0,
                .sum_bit_errors_squared = wrong * wrong,
                .sum_bits_squared = bits * bits,
                .sum_bit_errors_times_bits = wrong * bits};
    }
    result.points.push_back({.tally = tally});
  }
  return result;
}

// Where every frame is lost bit errors tell results apart.
TEST(Comparison, MeasuredOfBitErrorsThatComeInBursts) {
  const std::vector<double> errors{0.05, 0.5, 2, 5, 10};
  std::mt19937_64 random(5);
  int alarms = 0, found = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto a = lost(errors, random), b = lost(errors, random);
    alarms += sim::compare(a, b, 0.01).different() > 0;
    found += sim::compare(a, lost({0.05, 0.5, 5, 5, 10}, random), 0.01).different() == 1;
  }
  EXPECT_LE(alarms, 10);
  EXPECT_GE(found, 970);
}

TEST_F(CommandLine, DiffTellsEqualCompatibleAndDifferent) {
  write_scenario("s.toml", "receiver.range_m = [1, 2.2]");
  const auto run = [&](const std::string& name, const Words& more) {
    Words words{"run", "s.toml", "-q", "-o", name, "-n", "64"};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_EQ(program(words).code, 0);
  };
  run("a.h5", {});
  run("again.h5", {"-t", "1"});
  run("seed.h5", {"-S", "2"});
  run("dim.h5", {"--set", "led.current_ma=1"});
  run("other.h5", {"--set", "receiver.range_m=1,2"});
  EXPECT_EQ(program({"diff", "a.h5", "again.h5"}).out, "equal: the same counts at every point\n");
  const Outcome chance = program({"diff", "a.h5", "seed.h5"});
  EXPECT_EQ(chance.code, 0);
  EXPECT_EQ(chance.out,
            "compatible: no point of 2 differs in frame loss or BER by more than chance\n"
            "they are of other scenarios, options or seeds\n");
  const Outcome dim = program({"diff", "a.h5", "dim.h5"});
  EXPECT_EQ(dim.code, 1) << dim.out;
  EXPECT_TRUE(dim.out.starts_with("different: ")) << dim.out;
  EXPECT_NE(dim.out.find("receiver.range_m = 2.2, p = "), std::string::npos) << dim.out;
  expect_refused(
      {"diff", "a.h5", "other.h5"}, 2,
      "a.h5 and other.h5 (they are of different sweeps) give results of the same points");
  expect_refused({"diff", "a.h5", "s.toml"}, 2,
                 "s.toml (not a result of cosys-sim, or damaged) give a file that run wrote");
  expect_refused({"diff", "a.h5", "none.h5"}, 2, "none.h5 (no such file) check the path");
}

}  // namespace
