// What the signals that stop a run do to the process; each test in a process of its own.
#include "sim/threads/stop_signals.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "gtest/gtest.h"
#include "sim/text/new_file.hpp"

namespace sim {
namespace {

using Clock = std::chrono::steady_clock;

/// Ends the process: with code 0 if the signals, sent twice at once, only set the flag.
void expect_flag(int signal) {
  heed_signals();
  const std::atomic<bool>& stop = heed_stop_signals();
  const bool before = stop;
  std::raise(signal);
  std::raise(signal);
  std::_Exit(!before && stop ? 0 : 1);
}

/// The end waits until all that was put off is done.
void put_off(int signal) {
  heed_signals();
  const auto outer = std::make_unique<EndPutOff>();
  {
    const EndPutOff inner;
    std::raise(signal);
  }
  std::fputs("done\n", stderr);
}

/// In the middle of a file: it takes its place, and nothing is left beside it.
void write_through(const std::filesystem::path& place, int signal) {
  heed_signals();
  NewFile file(place);
  file.write("begun, ");
  std::raise(signal);
  file.write("done");
  file.take_place();
}

void raise_for_a_while() {
  heed_signals();
  heed_stop_signals();
  const auto began = Clock::now();
  while (Clock::now() - began < std::chrono::seconds(20)) std::raise(SIGINT);
  std::_Exit(1);
}

void hang_up_under_nohup() {
  std::signal(SIGHUP, SIG_IGN);
  heed_signals();
  const std::atomic<bool>& stop = heed_stop_signals();
  std::raise(SIGHUP);
  std::_Exit(stop ? 1 : 0);
}

void write_to_a_closed_pipe() {
  heed_signals();
  std::raise(SIGPIPE);
  std::raise(SIGXFSZ);
  std::_Exit(0);
}

TEST(StopSignalsDeathTest, TheFirstSetsAFlagAndSaysSo) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    EXPECT_EXIT(expect_flag(signal), testing::ExitedWithCode(0),
                "^cosys-sim: stopping \\(signal\\) once more to stop at once\n$");
}

TEST(StopSignalsDeathTest, WhereNothingIsKeptTheFirstEndsAtOnce) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto end = [=] {
      heed_signals();
      std::raise(signal);
      std::_Exit(1);
    };
    EXPECT_EXIT(end(), testing::ExitedWithCode(130),
                "^cosys-sim: interrupted \\(by a signal\\)\n$");
  }
}

TEST(StopSignalsDeathTest, TheEndCanBePutOff) {
  EXPECT_EXIT(put_off(SIGTERM), testing::ExitedWithCode(130),
              "^cosys-sim: interrupted \\(by a signal\\)\ndone\n$");
}

TEST(StopSignalsDeathTest, AFileIsWrittenToItsEndBefore) {
  std::string folder = (std::filesystem::temp_directory_path() / "cosys_signals.XXXXXX").string();
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  const std::filesystem::path place = std::filesystem::path(folder) / "file";
  EXPECT_EXIT(write_through(place, SIGTERM), testing::ExitedWithCode(130),
              "interrupted \\(by a signal\\)");
  std::string text;
  std::getline(std::ifstream(place), text);
  EXPECT_EQ(text, "begun, done");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  std::filesystem::remove_all(folder);
}

TEST(StopSignalsDeathTest, ALaterOneEndsAtOnce) {
  EXPECT_EXIT(raise_for_a_while(), testing::ExitedWithCode(130), "once more to stop at once");
}

TEST(StopSignalsDeathTest, OneThatLeavesThemEndsWithoutAWord) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const auto end = [=] {
      heed_signals();
      leave_stop_signals();
      std::raise(signal);
      std::_Exit(1);
    };
    EXPECT_EXIT(end(), testing::KilledBySignal(signal), "^$");
  }
}

TEST(StopSignalsDeathTest, NohupHolds) {
  EXPECT_EXIT(hang_up_under_nohup(), testing::ExitedWithCode(0), "");
}

TEST(StopSignalsDeathTest, WritingThatFailsIsNoSignal) {
  EXPECT_EXIT(write_to_a_closed_pipe(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace sim
