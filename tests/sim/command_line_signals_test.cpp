// What is left of a run that is stopped from outside.
#include <chrono>
#include <csignal>
#include <thread>

#include "program.hpp"

namespace {

constexpr int rows_begin = 3;  // lines of the table's head

const std::string farewell =
    "cosys-sim: interrupted (by a signal) what was counted is in the result file; the same command "
    "with --resume goes on\n";

const std::string promise = "cosys-sim: stopping (signal) once more to stop at once\n";

/// Reads the table's head and first row.
void read_first_row(Running& running) {
  for (int i = 0; i <= rows_begin; ++i) ASSERT_NE(running.line(), "");
}

TEST_F(CommandLine, SignalsKeepWhatIsFinished) {
  write_scenario("s.toml", "stop.max_frames = [16, 1e8]");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Running running = start_program({"run", "s.toml", "--threads", "2"});
    read_first_row(running);
    const Outcome o = running.finish(signal);
    EXPECT_EQ(o.code, 130);
    EXPECT_TRUE(o.err.ends_with(promise + farewell)) << o.err;
    EXPECT_TRUE(values("s.h5", "n_frames").starts_with("16, "));
    const std::string stop = values("s.h5", "stop_reason");
    EXPECT_TRUE(stop == "0, 2" || stop == "0, _") << stop;  // with or without frames counted
    EXPECT_EQ(files(), (std::set<std::string>{"s.toml", "s.h5"}));
    std::filesystem::remove(path("s.h5"));
  }
}

// A message of 200 characters at 1 Bd takes 34 minutes, 5e8 samples.
TEST_F(CommandLine, ASignalEndsALongTrialInItsMiddle) {
  write_scenario("s.toml", "receiver.range_m = 1");
  Running running = start_program({"run", "s.toml", "--set", "device.baud=1", "--set",
                                   "device.message=" + std::string(200, 'x')});
  for (int i = 0; i < rows_begin; ++i) ASSERT_NE(running.line(), "");
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(running.finish(SIGINT).code, 130);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(2));
}

TEST_F(CommandLine, AnInterruptedRunDoesNotStartTheNextScenario) {
  write_scenario("a.toml", "stop.max_frames = [16, 1e8]");
  write_scenario("b.toml", "receiver.range_m = 1");
  Running running = start_program({"run", "a.toml", "b.toml", "-o", "out", "-q"});
  read_first_row(running);
  const Outcome o = running.finish(SIGINT);
  EXPECT_EQ(o.code, 130);
  EXPECT_EQ(o.err, promise + farewell);
  EXPECT_EQ(files(), (std::set<std::string>{"a.toml", "b.toml", "out", "out/a.h5"}));
}

// Nothing is written in the first second of a point.
TEST_F(CommandLine, KilledEarlyItLeavesTheLastResult) {
  write_scenario("s.toml", "stop.max_frames = [1e8, 1]");
  ASSERT_EQ(program({"run", "s.toml", "--set", "stop.max_frames=8"}).code, 0);
  const std::string last_result = content(path("s.h5"));
  Running running = start_program({"run", "s.toml", "-q"});
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(running.finish(SIGKILL).code, -SIGKILL);
  EXPECT_TRUE(content(path("s.h5")) == last_result);
}

TEST_F(CommandLine, KilledLaterItLeavesTheFinishedPoint) {
  write_scenario("s.toml", "stop.max_frames = [16, 1e8]");
  Running running = start_program({"run", "s.toml"});
  read_first_row(running);
  EXPECT_EQ(running.finish(SIGKILL).code, -SIGKILL);
  EXPECT_TRUE(values("s.h5", "n_frames").starts_with("16, "));
}

}  // namespace
