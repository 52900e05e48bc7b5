// cosys-sim diff of results that are of no link.
#include "sim/result/dataset_comparison.hpp"

#include <random>
#include <string>

#include "gtest/gtest.h"
#include "program.hpp"
#include "sim/result/comparison.hpp"
#include "small_experiments.hpp"

namespace sim {
namespace {

Estimate share(std::uint64_t part, std::uint64_t whole) {
  const auto p = static_cast<double>(part), n = static_cast<double>(whole);
  const Interval ends = clopper_pearson(p, n, 0.95);
  return {p / n, ends.low, ends.high};
}

TEST(EstimateComparison, ComesNearFishersExactTest) {
  struct Pair {
    std::uint64_t a, b, n;
  };
  for (const auto& [a, b, n] : {Pair{20, 40, 200}, Pair{0, 10, 100}, Pair{0, 6, 10},
                                Pair{3, 9, 1000}, Pair{480, 530, 1000}}) {
    const double exact = fisher_exact(a, n, b, n);
    const double p = p_value_of_estimates(share(a, n), share(b, n));
    EXPECT_GT(p, exact / 2) << a << " and " << b << " of " << n;
    EXPECT_LT(p, exact * 2) << a << " and " << b << " of " << n;
    EXPECT_EQ(p, p_value_of_estimates(share(b, n), share(a, n)));
  }
  EXPECT_EQ(p_value_of_estimates(share(3, 10), share(3, 10)), 1);
}

TEST(EstimateComparison, SeldomCallsEqualsDifferent) {
  std::mt19937_64 random(7);
  std::binomial_distribution<std::uint64_t> lost(200, 0.1);
  int alarms = 0;
  constexpr int pairs = 2000;
  for (int i = 0; i < pairs; ++i)
    alarms += p_value_of_estimates(share(lost(random), 200), share(lost(random), 200)) < 0.05;
  EXPECT_LT(alarms, 0.06 * pairs);
  EXPECT_GT(alarms, 0.02 * pairs);
}

using Diff = CommandLine;

TEST_F(Diff, OfAnExperimentTellsEqualCompatibleAndDifferent) {
  for (const test::Experiment& experiment : test::small_experiments) {
    SCOPED_TRACE(experiment.name);
    write("e.toml", test::scenario_of(experiment, true));
    const auto run = [&](const std::string& name, const Words& more) {
      Words words{"run", "e.toml", "-q", "-o", name};
      if (experiment.name == std::string("location"))
        words.insert(words.end(), {"--set", "location.trials=4"});
      words.insert(words.end(), more.begin(), more.end());
      ASSERT_EQ(program(words).code, 0);
    };
    run("a.h5", {"-t", "2"});
    run("again.h5", {"-t", "1"});
    run("seed.h5", {"-S", "2"});
    const Outcome same = program({"diff", "a.h5", "again.h5"});
    EXPECT_EQ(same.out, "equal: the same counts at every point\n");
    const Outcome chance = program({"diff", "a.h5", "seed.h5"});
    EXPECT_EQ(chance.code, 0) << chance.out;
    EXPECT_TRUE(chance.out.starts_with("compatible: no ratio of ") ||
                (chance.out.starts_with("equal: ") && experiment.name == std::string("listening")))
        << chance.out;
    EXPECT_TRUE(chance.out.ends_with("they are of other scenarios, options or seeds\n"));
  }
}

TEST_F(Diff, NamesTheDeviceThatIsHeardLessOften) {
  write("e.toml", test::scenario_of(test::small_experiments[0], false));
  ASSERT_EQ(program({"run", "e.toml", "-q", "-o", "near.h5", "--set", "arena.runs=8"}).code, 0);
  ASSERT_EQ(program({"run", "e.toml", "-q", "-o", "far.h5", "--set", "arena.runs=8", "--set",
                     "devices.near.x_m=60"})
                .code,
            0);
  const Outcome o = program({"diff", "near.h5", "far.h5"});
  EXPECT_EQ(o.code, 1) << o.out;
  EXPECT_TRUE(o.out.starts_with("different: 2 of ")) << o.out;
  EXPECT_NE(o.out.find("device near, p = "), std::string::npos) << o.out;
  EXPECT_NE(o.out.find(": frame_loss "), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find("device away"), std::string::npos) << o.out;
}

TEST_F(Diff, RefusesResultsThatHaveNothingToCompare) {
  const auto run = [&](std::size_t which, const std::string& name, const Words& more) {
    write("e.toml", test::scenario_of(test::small_experiments[which], false));
    Words words{"run", "e.toml", "-q", "-o", name};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_EQ(program(words).code, 0);
  };
  run(0, "arena.h5", {});
  run(0, "swept.h5", {"--set", "devices.near.x_m=1,2"});
  run(1, "guard.h5", {});
  write_scenario("s.toml", "");
  ASSERT_EQ(program({"run", "s.toml", "-q", "-o", "link.h5", "-n", "8"}).code, 0);
  expect_refused(
      {"diff", "arena.h5", "swept.h5"}, 2,
      "arena.h5 and swept.h5 (they are of different sweeps) give results of the same points");
  expect_refused({"diff", "arena.h5", "guard.h5"}, 2,
                 "arena.h5 and guard.h5 (one is of an experiment \"arena\", the other of "
                 "\"guard\") give results of one experiment");
  expect_refused({"diff", "arena.h5", "link.h5"}, 2,
                 "arena.h5 (a result of another experiment than a link) give results of links");
  expect_refused({"diff", "arena.h5", "none.h5"}, 2, "none.h5 (no such file) check the path");
}

}  // namespace
}  // namespace sim
