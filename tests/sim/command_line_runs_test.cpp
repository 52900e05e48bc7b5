// Experiments that are no links lose no work and can be shared out: interrupts, kills and shards
// end in the digest of the plain run.
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "program.hpp"
#include "small_experiments.hpp"
#include "text_lines.hpp"

namespace {

using sim::last_line;
using sim::test::Experiment;
using sim::test::small_experiments;

class Runs : public CommandLine {
 protected:
  /// Writes s.toml and gives the words that run it with so many runs a point.
  Words runs_of(const Experiment& experiment, const std::string& n) const {
    write("s.toml", sim::test::scenario_of(experiment, true));
    return {"run", "s.toml", "-q", "-n", n};
  }

  /// Until a run has written its first checkpoint.
  void wait_for_result() const {
    for (int i = 0; i < 600 && !std::filesystem::exists(path("s.h5")); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }

  Outcome with(Words words, const Words& more) const {
    words.insert(words.end(), more.begin(), more.end());
    return program(words);
  }

  Outcome merge(const Words& files) const {
    Words words{"merge", "-o", "sum.h5"};
    words.insert(words.end(), files.begin(), files.end());
    return program(words);
  }
};

TEST_F(Runs, ShardsMergeToTheWholeRun) {
  for (const Experiment& experiment : small_experiments) {
    SCOPED_TRACE(experiment.name);
    const Words run = runs_of(experiment, "5");
    const Outcome whole = with(run, {"-o", "sum.h5"});
    ASSERT_EQ(whole.code, 0) << whole.err;
    for (const char* shard : {"1/3", "2/3", "3/3"})
      ASSERT_EQ(with(run, {"--shard", shard, "-t", "1"}).code, 0);
    const Outcome sum = merge({"s-2of3.h5", "s-3of3.h5", "s-1of3.h5"});
    EXPECT_EQ(sum.out, whole.out) << sum.err;
  }
}

TEST_F(Runs, AMergedPartSaysWhichRunsItHas) {
  const Words run = runs_of(small_experiments[5], "4");
  for (const char* shard : {"1/4", "3/4", "4/4"}) ASSERT_EQ(with(run, {"--shard", shard}).code, 0);
  const Outcome part = merge({"s-3of4.h5", "s-1of4.h5"});
  EXPECT_NE(part.out.find("\nshards 1/4 3/4 of the trials: cosys-sim merge adds the others\n"),
            std::string::npos)
      << part.out;
  std::filesystem::rename(path("sum.h5"), path("part.h5"));
  const Outcome more = merge({"s-4of4.h5", "part.h5"});
  EXPECT_NE(more.out.find("\nshards 1/4 3/4 4/4 of"), std::string::npos) << more.err;
}

// Who merges what was stopped is told so.
TEST_F(Runs, AStoppedShardIsTold) {
  const Words run = runs_of(small_experiments[3], "300000");
  Words half = run;
  half.insert(half.end(), {"--shard", "1/2"});
  Running running = start_program(half);
  for (int i = 0; i < 600 && !std::filesystem::exists(path("s-1of2.h5")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const Outcome stopped = running.finish(SIGTERM);
  EXPECT_EQ(stopped.code, 130);
  EXPECT_NE(stopped.out.find("unfinished: 2 of 2 points, 1 of them not begun; "), std::string::npos)
      << stopped.out;
  const Outcome sum = merge({"s-1of2.h5"});
  EXPECT_EQ(sum.code, 0);
  EXPECT_EQ(sum.err,
            "cosys-sim: some points are unfinished (their shards were stopped) run those shards "
            "with --resume and merge again\n");
}

// Kills at random instants, one of them kill -9; each time gone on with.
TEST_F(Runs, KillsChangeNothing) {
  std::mt19937 random(11);
  for (const Experiment& experiment : small_experiments) {
    SCOPED_TRACE(experiment.name);
    const Words run = runs_of(experiment, "16");
    const Outcome whole = with(run, {"-o", "whole.h5"});
    ASSERT_EQ(whole.code, 0) << whole.err;
    for (int kill = 0; kill < 2; ++kill) {
      Words again = run;
      again.insert(again.end(), {"--resume", "-t", std::to_string(1 + kill % 2)});
      Running running = start_program(again);
      std::this_thread::sleep_for(std::chrono::milliseconds(50 + random() % 400));
      running.finish(kill % 2 == 0 ? SIGKILL : SIGTERM);
    }
    const Outcome last = with(run, {"--resume"});
    EXPECT_EQ(last.code, 0) << last.err;
    EXPECT_EQ(digest_of(last.out), digest_of(whole.out));
    std::filesystem::remove(path("s.h5"));
  }
}

// What was counted is in the file while the run goes on: a kill -9 loses a few seconds.
TEST_F(Runs, AKilledRunLeavesWhatItCounted) {
  const Words run = runs_of(small_experiments[3], "300000");
  Running running = start_program(run);
  wait_for_result();
  running.finish(SIGKILL);
  const std::string counted = values("s.h5", "n_trials");
  EXPECT_NE(counted.substr(0, 2), "0,") << counted;
  EXPECT_EQ(program({"report", "s.h5", "-o", "r.html"}).code, 0);
}

TEST_F(Runs, AnInterruptSaysHowToGoOn) {
  Running running = start_program(runs_of(small_experiments[3], "3000000"));
  wait_for_result();
  const Outcome o = running.finish(SIGTERM);
  EXPECT_EQ(o.code, 130);
  EXPECT_NE(o.err.find("what was counted is in the result file; the same command with --resume "
                       "goes on\n"),
            std::string::npos)
      << o.err;
}

TEST_F(Runs, ResumingAFinishedRunSaysTheSame) {
  const Words run = runs_of(small_experiments[0], "2");
  const Outcome first = with(run, {});
  EXPECT_EQ(with(run, {"--resume"}).out, first.out);
}

TEST_F(Runs, RefusesWhatIsNotTheSameRun) {
  const std::string remedy = " leave out --resume to start anew, or name another -o";
  const Words run = runs_of(small_experiments[4], "6");
  ASSERT_EQ(with(run, {}).code, 0);
  const auto refused = [&](const Words& more, const std::string& why) {
    Words words = run;
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(words, 2, "cannot resume s.h5 (" + why + ")" + remedy, "/dev/null");
  };
  refused({"--resume", "--seed", "2"}, "it has another seed");
  refused({"--resume", "--set", "location.device_x_m=1"},
          "it is of another scenario, or of other options");
  refused({"--resume", "--shard", "1/2", "-o", "s.h5"}, "it has other trials: shard 1/1");
}

TEST_F(Runs, RefusesWhatDoesNotBelongTogether) {
  const Words run = runs_of(small_experiments[4], "6");
  for (const char* shard : {"1/2", "2/4"}) ASSERT_EQ(with(run, {"--shard", shard}).code, 0);
  ASSERT_EQ(with(run, {"--shard", "2/2", "-S", "5", "-o", "seed.h5"}).code, 0);
  write_scenario("l.toml", "receiver.range_m = [1, 2]");
  ASSERT_EQ(program({"run", "l.toml", "-q"}).code, 0);
  const std::string which = " with what stands before it";
  const std::string remedy = " give shards of one command, each once";
  expect_refused(
      {"merge", "s-1of2.h5", "s-2of4.h5", "-o", "sum.h5"}, 2,
      "cannot merge s-2of4.h5" + which + " (trials of its shard 2/4 are there already)" + remedy);
  expect_refused({"merge", "s-1of2.h5", "seed.h5", "-o", "sum.h5"}, 2,
                 "cannot merge seed.h5" + which + " (it has another seed)" + remedy);
  EXPECT_EQ(program({"merge", "s-1of2.h5", "l.h5", "-o", "sum.h5"}).code, 2);
  EXPECT_EQ(program({"merge", "l.h5", "s-1of2.h5", "-o", "sum.h5"}).code, 2);
  Words few = run;
  few.insert(few.end(), {"--shard", "1/7"});
  expect_refused(few, 2,
                 "--shard 1/7 (6 runs are too few for 7 shards) use fewer shards or more runs");
}

// Any byte may be damaged: it is refused, or the damage is none of the counts.
TEST_F(Runs, ResumeRefusesDamage) {
  const Words run = runs_of(small_experiments[3], "8");
  const std::string digest = digest_of(with(run, {}).out);
  const std::string whole = content(path("s.h5"));
  int refused = 0;
  for (std::size_t at = 8; at < whole.size(); at += whole.size() / 20) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    write("s.h5", damaged);
    const Outcome o = with(run, {"--resume"});
    refused += o.code == 2;
    EXPECT_TRUE(o.code == 2 || (o.code == 0 && digest_of(o.out) == digest)) << at << o.err;
    EXPECT_LE(std::ranges::count(o.err, '\n'), 1) << o.err;
  }
  EXPECT_GT(refused, 0);
}

// Of some runs a point; nothing is written.
TEST_F(Runs, APlanSaysWhatARunWillTake) {
  for (const Experiment& experiment : small_experiments) {
    SCOPED_TRACE(experiment.name);
    Words words = runs_of(experiment, "6");
    words.emplace_back("--plan");
    const Outcome o = program(words);
    EXPECT_EQ(o.code, 0) << o.err;
    const std::string last = last_line(o.out);
    EXPECT_NE(last.find(" points: "), std::string::npos) << last;
    EXPECT_NE(last.find(" runs, "), std::string::npos) << last;
    EXPECT_EQ(files(), std::set<std::string>{"s.toml"});
  }
}

// What the budget chose is in the result, so the run can be repeated.
TEST_F(Runs, ATimeBudgetChoosesTheRuns) {
  write("s.toml", sim::test::scenario_of(small_experiments[3], true));
  const Outcome o = program({"run", "s.toml", "-q", "--time-budget", "1s"});
  ASSERT_EQ(o.code, 0) << o.err;
  const std::string key = "--max-frames ";
  const std::size_t at = o.err.find(key);
  ASSERT_NE(at, std::string::npos) << o.err;
  const std::string trials =
      o.err.substr(at + key.size(), o.err.find(' ', at + key.size()) - at - key.size());
  EXPECT_GT(std::stoi(trials), 8);
  EXPECT_EQ(values("s.h5", "n_trials"), trials + ", " + trials);
  expect_refused({"run", "s.toml", "--time-budget", "1s", "--set", "presence.trials=8,9"}, 2,
                 "--time-budget (presence.trials is swept in s.toml) leave one of the two out");
}

}  // namespace
