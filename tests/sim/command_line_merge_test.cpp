// Shards of a run, on machines that do not know of each other, add up to the run.
#include <chrono>
#include <csignal>
#include <thread>

#include "program.hpp"
#include "text_lines.hpp"

namespace {

using sim::last_line;

class Merge : public CommandLine {
 protected:
  Merge() { write_scenario("s.toml", "receiver.range_m = [1, 2.2, 3]"); }

  void run(const Words& more, const std::string& frames = "107") const {
    Words words{"run", "s.toml", "-q", "-n", frames};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome o = program(words);
    ASSERT_EQ(o.code, 0) << o.err;
  }
  void run_shard(const std::string& shard) const { run({"--shard", shard}); }

  Outcome merge(const Words& files, const std::string& to) const {
    Words words{"merge"};
    words.insert(words.end(), files.begin(), files.end());
    words.insert(words.end(), {"-o", to});
    return program(words);
  }
};

TEST_F(Merge, ShardsAddUpToTheWholeRun) {
  run({"-o", "whole.h5"});
  for (const char* shard : {"1/2", "3/4", "7/8", "8/8"}) run_shard(shard);
  const Outcome o = merge({"s-7of8.h5", "s-1of2.h5", "s-8of8.h5", "s-3of4.h5"}, "sum.h5");
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.out.find("shards"), std::string::npos) << o.out;
  EXPECT_EQ(program({"diff", "sum.h5", "whole.h5"}).out, "equal: the same counts at every point\n");
  for (const char* variable : {"n_frames", "irradiance_mw_per_m2", "flr_ci_high", "stop_reason"})
    EXPECT_EQ(values("sum.h5", variable), values("whole.h5", variable)) << variable;
}

TEST_F(Merge, OrderDoesNotMatter) {
  for (const char* shard : {"1/3", "2/3", "3/3"}) run_shard(shard);
  const Outcome one = merge({"s-1of3.h5", "s-2of3.h5", "s-3of3.h5"}, "sum.h5");
  ASSERT_EQ(merge({"s-3of3.h5", "s-1of3.h5"}, "part.h5").code, 0);
  const Outcome other = merge({"part.h5", "s-2of3.h5"}, "sum.h5");
  EXPECT_EQ(last_line(one.out), last_line(other.out));
}

TEST_F(Merge, SaysWhichTrialsTheSumHas) {
  run_shard("1/4");
  run_shard("3/4");
  const Outcome o = merge({"s-1of4.h5", "s-3of4.h5"}, "sum.h5");
  EXPECT_NE(o.out.find("\nshards 1/4 3/4 of the trials: cosys-sim merge adds the others\n"),
            std::string::npos)
      << o.out;
  EXPECT_EQ(values("sum.h5", "n_frames"), "48, 48, 48");
}

// A shard that was stopped can be gone on with, so its file is not written over.
TEST_F(Merge, AStoppedShardIsToldAndNotOverwritten) {
  run_shard("1/2");
  Running running = start_program({"run", "s.toml", "-q", "-n", "100000", "--shard", "2/2"});
  while (!files().contains("s-2of2.h5")) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  running.finish(SIGTERM);
  EXPECT_EQ(program({"merge", "s-2of2.h5", "-o", "sum.h5"}).err,
            "cosys-sim: some points are unfinished (their shards were stopped) run those shards "
            "with --resume and merge again\n");
  expect_refused({"merge", "s-1of2.h5", "s-2of2.h5", "-o", "./s-2of2.h5"}, 2,
                 "-o ./s-2of2.h5 (it is one of the results to be merged) name another file");
}

TEST_F(Merge, AStoppedShardIsGoneOnWith) {
  run({"-o", "whole.h5"}, "1000");
  const Words half{"run", "s.toml", "-q", "-n", "1000", "--shard", "2/2", "-t", "1"};
  Running running = start_program(half);
  running.line();
  running.finish(SIGTERM);
  run({"--shard", "1/2"}, "1000");
  Words again = half;
  again.emplace_back("--resume");
  ASSERT_EQ(program(again).code, 0);
  ASSERT_EQ(merge({"s-1of2.h5", "s-2of2.h5"}, "sum.h5").code, 0);
  EXPECT_EQ(program({"diff", "sum.h5", "whole.h5"}).out, "equal: the same counts at every point\n");
}

TEST_F(Merge, LossesAreSharedOut) {
  run({"-e", "9", "--shard", "2/2"}, "400");
  EXPECT_EQ(values("s-2of2.h5", "stop_reason"), "0, 1, 1");
  EXPECT_EQ(values("s-2of2.h5", "n_frames_lost").substr(0, 3), "0, ");
}

TEST_F(Merge, RefusesWhatDoesNotBelongTogether) {
  const std::string which = " with what stands before it";
  const std::string remedy = " give shards of one command, each once";
  run_shard("1/2");
  run_shard("2/4");
  run({"--shard", "2/2", "-S", "5", "-o", "seed.h5"});
  run({"--shard", "2/2", "--set", "led.current_ma=50", "-o", "dim.h5"});
  expect_refused(
      {"merge", "s-1of2.h5", "s-2of4.h5", "-o", "sum.h5"}, 2,
      "cannot merge s-2of4.h5" + which + " (trials of its shard 2/4 are there already)" + remedy);
  expect_refused(
      {"merge", "s-1of2.h5", "s-1of2.h5", "-o", "sum.h5"}, 2,
      "cannot merge s-1of2.h5" + which + " (trials of its shard 1/2 are there already)" + remedy);
  expect_refused({"merge", "s-1of2.h5", "seed.h5", "-o", "sum.h5"}, 2,
                 "cannot merge seed.h5" + which + " (it has another seed)" + remedy);
  expect_refused(
      {"merge", "s-1of2.h5", "dim.h5", "-o", "sum.h5"}, 2,
      "cannot merge dim.h5" + which + " (it is of another scenario, or of other options)" + remedy);
  expect_refused({"merge", "s-1of2.h5", "none.h5", "-o", "sum.h5"}, 2,
                 "none.h5 (no such file) check the path");
  expect_refused(
      {"run", "s.toml", "-q", "-n", "107", "--shard", "2/2", "--resume", "-o", "s-1of2.h5"}, 2,
      "cannot resume s-1of2.h5 (it has other trials: shard 1/2) leave out --resume to "
      "start anew, or name another -o",
      "/dev/null");
}

TEST_F(Merge, RefusesWhatCannotBeSharedOut) {
  const std::string wrong = " is no shard K/N, with K from 1 to N and N up to 100000";
  for (const char* shard : {"0/4", "5/4", "x", "1/0", ""})
    expect_refused(
        {"run", "s.toml", "--shard", shard}, 2,
        std::string("--shard: ") + shard + wrong + " (wrong usage) see cosys-sim run --help");
  expect_refused({"run", "s.toml", "--shard", "1/16"}, 2,
                 "--shard 1/16 (16 frames are too few for 16 shards) use fewer shards or more "
                 "frames, at least 8 for each");
  expect_refused({"run", "s.toml", "--shard", "1/2", "--rel-ci", "0.1"}, 2,
                 "--shard 1/2 (--rel-ci and --target-flr need the counts of all shards) use "
                 "--max-frames and --max-frame-errors, which can be shared out");
}

}  // namespace
