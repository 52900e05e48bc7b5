// `find` as users meet it.
#include <chrono>
#include <csignal>
#include <thread>

#include "program.hpp"

namespace {

class Find : public CommandLine {
 protected:
  Find() { write_scenario("s.toml", "receiver.range_m = [1, 5]"); }
};

TEST_F(Find, TellsWhereTheLossCrosses) {
  const Outcome o = program({"find", "s.toml", "--over", "receiver.range_m", "-n", "400"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("the link reaches "), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("s-find.h5: digest "), std::string::npos);
  EXPECT_EQ(files(), (std::set<std::string>{"s.toml", "s-find.h5"}));
}

// What was looked at is a sweep: its own text, run again, gives the same counts.
TEST_F(Find, IsASweepThatCanBeRepeated) {
  ASSERT_EQ(program({"find", "s.toml", "--over", "receiver.range=1:5m", "-t", "1", "--tolerance",
                     "0.1", "-n", "400"})
                .code,
            0);
  write("again.toml", tool("/usr/bin/python3", {"-c",
                                                "import netCDF4; print(netCDF4.Dataset('s-find.h5')"
                                                ".scenario_toml, end='')"}));
  const Outcome again = program({"run", "again.toml", "-q"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(program({"diff", "s-find.h5", "again.h5"}).out,
            "equal: the same counts at every point\n");
}

TEST_F(Find, SearchesForEachValueOfOtherAxes) {
  write_scenario("two.toml", "receiver.range_m = [1, 5]\nled.current_ma = [20, 100]");
  const Outcome o = program(
      {"find", "two.toml", "--over", "receiver.range_m", "--tolerance", "0.1", "-n", "400"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("receiver.range_m at which frame loss passes 1 %:\n"), std::string::npos)
      << o.out;
  const Outcome current =
      program({"find", "two.toml", "--over", "led.current_ma", "--tolerance", "0.1", "-n", "400"});
  EXPECT_NE(current.out.find("led.current_ma at which frame loss passes 1 %:\n"), std::string::npos)
      << current.out;
}

TEST_F(Find, InterruptedKeepsWhatWasCounted) {
  Running running = start_program(
      {"find", "s.toml", "--over", "receiver.range_m", "-n", "1000000", "--flr", "1e-8"});
  running.line();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const Outcome o = running.finish(SIGTERM);
  EXPECT_EQ(o.code, 130);
  EXPECT_TRUE(o.err.ends_with(
      "cosys-sim: interrupted (by a signal) what was counted is in the result file\n"));
  EXPECT_EQ(values("s-find.h5", "stop_reason").substr(0, 1), "2");
}

// What was counted belongs to the files that were read first.
TEST_F(Find, FilesThatChangeMeanwhileDoNotMatter) {
  const Words find{"find", "s.toml", "--over",      "receiver.range_m",
                   "-n",   "400",    "--tolerance", "0.1"};
  const std::string digest = digest_of(program(find).out);
  Running running = start_program(find);
  running.line();
  write("s.toml", "nonsense");
  const Outcome o = running.finish();
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(digest_of(o.out), digest);
}

TEST_F(Find, RefusesInOneLine) {
  const std::string how =
      " write KEY=LOW:HIGH, such as receiver.range_m=1:40, or KEY if the scenario sweeps it";
  const auto refused = [&](const std::string& over, const std::string& why) {
    expect_refused({"find", "s.toml", "--over", over}, 2,
                   "--over " + over + " (" + why + ")" + how);
  };
  expect_refused({"find", "s.toml", "--over", "receiver.rang"}, 2,
                 "receiver.rang in --over (no such key) did you mean receiver.range_m?");
  expect_refused({"find", "s.toml", "--over", "receiver.range=1s:2s"}, 2,
                 "--over receiver.range=1s:2s (\"s\" is no m) write the number in m");
  refused("receiver.module", "its values are no numbers");
  refused("led.current_ma", "the scenario does not sweep it");
  refused("receiver.range_m=3", "not two numbers with a colon between");
  refused("receiver.range_m=1:2:3", "not two numbers with a colon between");
  refused("receiver.range_m=1:x", "not two numbers with a colon between");
  refused("receiver.range_m=nan:2", "not two numbers with a colon between");
  refused("simulation.seed=1:9", "no loss depends on it");
  refused("stop.max_frames=1:9", "no loss depends on it");
  refused("receiver.range_m=2:2", "both ends are the same");
  EXPECT_EQ(program({"find", "s.toml", "--over", "receiver.range_m=0:2"}).code, 2);
  EXPECT_EQ(program({"find", "s.toml", "--over", "receiver.range_m", "--flr", "nan"}).code, 2);
  EXPECT_EQ(program({"find", "s.toml"}).code, 2);
  EXPECT_EQ(files(), std::set<std::string>{"s.toml"});
}

}  // namespace
