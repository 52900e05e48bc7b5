// cosys-sim diff of results that are of no link.
#include "sim/result/dataset_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "gtest/gtest.h"
#include "program.hpp"
#include "sim/counting/holm.hpp"
#include "sim/counting/statistics.hpp"
#include "sim/result/comparison.hpp"
#include "small_experiments.hpp"

namespace sim {
namespace {

Estimate share(std::uint64_t part, std::uint64_t whole) {
  const auto p = static_cast<double>(part), n = static_cast<double>(whole);
  const Interval ends = clopper_pearson(p, n, 0.95);
  return {p / n, ends.low, ends.high};
}

constexpr double as_normal = 1e6;  // degrees of freedom: as good as normal

TEST(EstimateComparison, ComesNearFishersExactTest) {
  struct Pair {
    std::uint64_t a, b, n;
  };
  for (const auto& [a, b, n] : {Pair{20, 40, 200}, Pair{0, 10, 100}, Pair{0, 6, 10},
                                Pair{3, 9, 1000}, Pair{480, 530, 1000}}) {
    const double exact = fisher_exact(a, n, b, n);
    const double p = p_value_of_estimates(share(a, n), share(b, n), as_normal);
    EXPECT_GT(p, exact / 2) << a << " and " << b << " of " << n;
    EXPECT_LT(p, exact * 2) << a << " and " << b << " of " << n;
    EXPECT_EQ(p, p_value_of_estimates(share(b, n), share(a, n), as_normal));
  }
  EXPECT_EQ(p_value_of_estimates(share(3, 10), share(3, 10), as_normal), 1);
}

TEST(EstimateComparison, OfWhatIsTooLargeTellsNothing) {
  const double huge = 1.7e308;
  EXPECT_EQ(p_value_of_estimates({-huge, -huge, huge}, {huge, -huge, huge}, 7), 1);
  EXPECT_EQ(p_value_of_estimates({0, 0, 0}, {1, 1, 1}, 7), 0);
}

Dataset measured_sweep(const std::vector<double>& values, const std::vector<double>& runs) {
  const auto moved = [&](double by) {
    std::vector<double> ends = values;
    for (double& end : ends) end += by;
    return ends;
  };
  Dataset data;
  data.axes = {{"simulation.seed", "1", "", {1000001, 1000002, 1000003}}};
  const std::vector<std::int64_t> counts(runs.begin(), runs.end());
  data.variables = {{{"n_runs", "1", ""}, true, {}, counts},
                    {{"loss", "1", ""}, true, {}, values},
                    {{"loss_ci_low", "1", ""}, true, {}, moved(-0.1)},
                    {{"loss_ci_high", "1", ""}, true, {}, moved(0.1)}};
  return data;
}

TEST(EstimateComparison, PointsThatReadAlikeAreKeptApart) {
  const Dataset one = measured_sweep({0.1, 0.5, 0.9}, {1000, 1000, 1000});
  const DatasetComparison same = compare(one, one, 0.01);
  ASSERT_EQ(same.tests.size(), 3U);
  for (const CellTest& test : same.tests) EXPECT_EQ(test.p_value, 1) << test.one.value;
}

TEST(EstimateComparison, FewRunsTellLess) {
  const Dataset one = measured_sweep({0.3, 0.3, 0.3}, {1000, 8, 2});
  const DatasetComparison c =
      compare(one, measured_sweep({0.6, 0.6, 0.6}, {1000, 1000, 1000}), 0.01);
  EXPECT_LT(c.tests[0].p_value, 1e-4);
  EXPECT_GT(c.tests[1].p_value, 20 * c.tests[0].p_value) << "of 8 runs: Student's t of 7";
  EXPECT_GT(c.tests[2].p_value, c.tests[1].p_value);
}

TEST(EstimateComparison, CountsWhatOnlyOneHas) {
  Dataset one = measured_sweep({0.1, std::nan(""), 0.9}, {9, 0, 9}), other = one;
  other.variables[1].values = std::vector<double>{0.1, 0.5, std::nan("")};
  EXPECT_EQ(compare(one, other, 0.01).unknown, 1U) << "the interval of one is not known";
  EXPECT_EQ(compare(one, other, 0.01).tests.size(), 1U);
}

/// A share of runs, each of which loses much or little.
Estimate clustered_share(std::mt19937_64& random, int runs) {
  ClusterSums sums;
  std::bernoulli_distribution bad(0.3);
  for (int i = 0; i < runs; ++i) {
    std::binomial_distribution<std::uint64_t> lost(50, bad(random) ? 0.6 : 0.1);
    sums.add(lost(random), 50);
  }
  return clustered_ratio(sums, 0.95);
}

TEST(EstimateComparison, SeldomCallsEqualsDifferent) {
  std::mt19937_64 random(7);
  constexpr int experiments = 400, tests = 20, runs = 8;
  constexpr double alpha = 0.05;
  int alarms = 0;
  for (int i = 0; i < experiments; ++i) {
    std::vector<double> p_values;
    for (int k = 0; k < tests; ++k)
      p_values.push_back(p_value_of_estimates(clustered_share(random, runs),
                                              clustered_share(random, runs), runs - 1));
    const std::vector<bool> rejected = rejected_by_holm(p_values, alpha);
    alarms += std::ranges::find(rejected, true) != rejected.end() ? 1 : 0;
  }
  EXPECT_LE(alarms, 1.3 * alpha * experiments);
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
