// A plan predicts what a run then takes, and a time budget is met.
#include "sim/engine/plan.hpp"

#include "program.hpp"
#include "sim/report/plan_report.hpp"

namespace sim {
namespace {

/// 1000 frames of which so many are lost, with ten wrong bits each.
Tally lost_of_1000(std::uint64_t lost) {
  return {.n_bits = 170000,
          .n_bit_errors = 10 * lost,
          .n_frames = 1000,
          .n_frames_lost = lost,
          .n_frames_bit_errors = lost,
          .sum_bit_errors_squared = 100 * lost,
          .sum_bits_squared = 1000 * 170 * 170,
          .sum_bit_errors_times_bits = 1700 * lost};
}

/// Of a link whose pilot was that, for a run of at most so many frames as the rule says.
RunPilot pilot_of(const Tally& tally, const StopRule& rule) {
  return {.coordinates = {},
          .runs = rule.max_frames,
          .rule = rule,
          .group = 8,
          .run_s = 0.01,
          .counted = 1000,
          .ratio = bit_error_ratio(tally, 0.95),
          .loss = frame_loss_ratio(tally, sure_level),
          .losses = worth_of_losses(tally)};
}
RunPilot pilot_of(std::uint64_t lost, const StopRule& rule) {
  return pilot_of(lost_of_1000(lost), rule);
}

TEST(Plan, SaysOfSomePointsThatTheyAreNotAll) {
  LoadedScenario scenario;
  scenario.sweep = {{"receiver.range_m", "m", "distance along the floor", {1, 2, 3}}};
  RunPilot pilot = pilot_of(100, {.max_frames = 500});
  pilot.coordinates = {1};
  const std::string some = plan_table(scenario, {pilot, pilot}, 2);
  EXPECT_NE(some.find("\nunfinished: 2 of 3 points: "), std::string::npos) << some;
  const std::string all = plan_table(scenario, {pilot, pilot, pilot}, 2);
  EXPECT_NE(all.find("\n3 points: "), std::string::npos) << all;
}

TEST(Plan, ExpectsTheFramesThatTheRuleWillNeed) {
  EXPECT_EQ(expected_runs(pilot_of(0, {.max_frames = 500})), 500);
  EXPECT_NEAR(expected_runs(pilot_of(100, {.max_frames = 100000, .max_frame_errors = 50})), 500, 8);
  EXPECT_EQ(expected_runs(pilot_of(100, {.max_frames = 300, .max_frame_errors = 50})), 300);
  // Of 10 % of the frames the ratio is known to 10 % after 1.96^2 * 9 / 0.01 frames.
  EXPECT_NEAR(expected_runs(pilot_of(100, {.max_frames = 100000, .rel_ci = 0.1})), 3457, 200);
  EXPECT_EQ(expected_runs(pilot_of(0, {.max_frames = 100000, .rel_ci = 0.1})), 100000);
  // 3.3^2 * .1 * .9 / .05^2 frames.
  EXPECT_NEAR(expected_runs(pilot_of(100, {.max_frames = 100000, .target_flr = 0.05})), 400, 20);
  EXPECT_EQ(expected_runs(pilot_of(0, {.max_frames = 100000, .target_flr = 0.01})), 760);
  // Where no loss was seen none is expected.
  EXPECT_EQ(expected_runs(pilot_of(0, {.max_frames = 100000, .max_frame_errors = 50})), 100000);
}

// Runs that are counted one by one are looked at behind every eighth.
TEST(Plan, ExpectsTheNextLookOfTheRule) {
  RunPilot pilot{.coordinates = {}, .runs = 100, .rule = {.rel_ci = 0.1}, .counted = 10};
  const auto expected = [&](double half_width) {
    pilot.ratio = {1, 1 - half_width, 1 + half_width};
    return expected_runs(pilot);
  };
  EXPECT_EQ(expected(0.01), 8);   // of 0.1 runs
  EXPECT_EQ(expected(0.11), 16);  // of 12.1
  EXPECT_EQ(expected(1), 100);
  pilot.ratio = {};
  EXPECT_EQ(expected_runs(pilot), 100) << "nothing was seen";
}

// The last round of the threads is a whole one.
TEST(Plan, TellsTheTimeByRounds) {
  RunPilot pilot{.coordinates = {}, .runs = 1, .threads = 4, .setup_s = 1, .run_s = 0.5};
  EXPECT_EQ(expected_seconds(pilot), 3);
  pilot.runs = 4;
  EXPECT_EQ(expected_seconds(pilot), 3);
  pilot.runs = 5;
  EXPECT_EQ(expected_seconds(pilot), 5);
}

// 1000 drawn frames that are all lost are worth half if half of the weights are small.
TEST(Plan, ExpectsOfWeightedLossesWhatTheyAreWorth) {
  Tally tally = lost_of_1000(1000);
  for (int i = 0; i < 1000; ++i) {
    const std::vector<double> weight{i % 2 == 0 ? 1 : 0.01};
    tally.weighted.n_groups += 1;
    tally.weighted.bit_errors += weighted_sum(weight);
    tally.weighted.frames_lost += weighted_sum(weight);
  }
  // (500 + 5)^2 / (500 + .05) are 510.
  EXPECT_NEAR(expected_runs(pilot_of(tally, {.max_frames = 100000, .max_frame_errors = 50})), 98,
              8);
}

TEST(Plan, FillsTheTime) {
  const StopRule any{.max_frames = 1};
  const std::vector<RunPilot> pilots{pilot_of(0, any), pilot_of(0, any), pilot_of(0, any)};
  EXPECT_EQ(runs_within(pilots, 30.3, 4e9), 1008u);
  EXPECT_EQ(runs_within(pilots, 1e-9, 4e9), 8u);
  EXPECT_EQ(runs_within(pilots, 1e12, 4e9), 4000000000u);
  // Where losses end two of the points the third has their time.
  const StopRule losses{.max_frames = 1, .max_frame_errors = 10};
  EXPECT_NEAR(static_cast<double>(runs_within(
                  {pilot_of(0, any), pilot_of(100, losses), pilot_of(1000, losses)}, 30.3, 4e9)),
              2904, 16);
}

TEST(Plan, DurationsAreReadable) {
  EXPECT_EQ(duration_text(0.0123), "0.012 s");
  EXPECT_EQ(duration_text(9.99), "10 s");
  EXPECT_EQ(duration_text(59.6), "1 min 0 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(3599.7), "1 h 0 min");
  EXPECT_EQ(duration_text(86400), "24 h 0 min");
  EXPECT_EQ(duration_text(1e6), "12 days");
}

TEST_F(CommandLine, PlanRunsNothing) {
  write_scenario("s.toml", "receiver.range_m = [1, 3]");
  const Outcome o = program({"run", "s.toml", "--plan", "-n", "104", "-t", "2"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("\n2 points: 208 frames, "), std::string::npos) << o.out;
  EXPECT_EQ(files(), std::set<std::string>{"s.toml"});
}

// A trial of a microsecond is timed over enough of them.
TEST_F(CommandLine, PlanOfDecisionsExpectsARunOfSeconds) {
  write_scenario("s.toml", "receiver.ebn0_db = [12, 14]");
  const Outcome o =
      program({"run", "s.toml", "--plan", "-n", "1e7", "-t", "2", "--set",
               "simulation.fidelity=decision", "--set", "receiver.module=ideal-coherent"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("\n2 points: 20000000 frames, "), std::string::npos) << o.out;
  EXPECT_EQ(o.out.find(" days"), std::string::npos) << o.out;
  for (const char* nonsense : {"inf", "nan", "  0 s"})
    EXPECT_EQ(o.out.find(nonsense), std::string::npos) << o.out;
}

// What the budget chose is in the result, so the run can be repeated.
TEST_F(CommandLine, TimeBudgetChoosesTheFrames) {
  write_scenario("s.toml", "receiver.range_m = [1, 3]");
  const Outcome o = program({"run", "s.toml", "--time-budget", "2s"});
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string key = "--max-frames ";
  const std::size_t at = o.err.find(key);
  ASSERT_NE(at, std::string::npos) << o.err;
  const std::string frames =
      o.err.substr(at + key.size(), o.err.find(' ', at + key.size()) - at - key.size());
  EXPECT_GT(std::stoi(frames), 16);
  EXPECT_EQ(values("s.h5", "n_frames"), frames + ", " + frames);
  ASSERT_EQ(program({"run", "s.toml", "-q", "-n", frames, "--resume"}).code, 0);
}

TEST_F(CommandLine, TimeBudgetIsRefusedWhereItCannotBeKept) {
  write_scenario("s.toml", "stop.max_frames = [8, 16]");
  expect_refused({"run", "s.toml", "--time-budget", "2s"}, 2,
                 "--time-budget (stop.max_frames is swept in s.toml) leave one of the two out");
  for (const char* wrong : {"0s", "nans", "-1s", "5", "x", "1e300h", "1e9h", "1s2"})
    EXPECT_EQ(program({"run", "s.toml", "--time-budget", wrong}).code, 2) << wrong;
  for (const Words& other : {Words{"--resume"}, {"--shard", "1/2"}, {"--plan"}, {"-n", "8"}}) {
    Words words{"run", "s.toml", "--time-budget", "2s"};
    words.insert(words.end(), other.begin(), other.end());
    EXPECT_EQ(program(words).code, 2) << other.front();
  }
}

}  // namespace
}  // namespace sim
