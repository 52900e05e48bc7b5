// Where the program's output goes: closed, full and short-sighted readers, and files that are
// there.
#include <poll.h>
#include <sys/inotify.h>

#include <algorithm>
#include <csignal>

#include "program.hpp"

namespace {

class CommandLineOutput : public CommandLine {
 protected:
  /// What a script prints in which $P is the program.
  std::string script(const std::string& text) const {
    return tool("bash", {"-c", "P='" COSYS_PROGRAM "'\n" + text});
  }
};

/// Waits for files that take their place in a folder.
class Arrivals {
 public:
  explicit Arrivals(const std::filesystem::path& folder) : queue_(::inotify_init1(IN_CLOEXEC)) {
    ::inotify_add_watch(queue_, folder.c_str(), IN_MOVED_TO);
  }
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;
  ~Arrivals() { ::close(queue_); }

  bool wait() const {
    constexpr int patience_ms = 60000;
    pollfd arrival{.fd = queue_, .events = POLLIN, .revents = 0};
    return ::poll(&arrival, 1, patience_ms) == 1;
  }

 private:
  int queue_;
};

// Progress and farewells are words; a run for which nobody listens to them is as good.
TEST_F(CommandLineOutput, AnUnwritableStderrEndsNothing) {
  write_scenario("s.toml", "stop.max_frames = [16, 1e8]");
  for (const std::string err : {"2>/dev/full", "2>&-"}) {
    EXPECT_EQ(script("rm -f rows; mkfifo rows; $P run s.toml >rows " + err +
                     " &\n"
                     "exec 3<rows; for i in 1 2 3 4; do read -r row <&3; done\n"
                     "kill -TERM $!; cat <&3 >copy; wait $!; echo $?"),
              "130\n")
        << err;
    EXPECT_TRUE(values("s.h5", "n_frames").starts_with("16, "));
  }
}

TEST_F(CommandLineOutput, AReaderThatHasSeenEnoughLosesNothing) {
  write_scenario("s.toml", "receiver.range_m = \"1:0.001:9\"");
  EXPECT_EQ(script("$P run s.toml -q 2>err | head -4 >rows; echo ${PIPESTATUS[0]}"), "141\n");
  EXPECT_EQ(content(path("err")), "");
  EXPECT_TRUE(values("s.h5", "n_frames").starts_with("16, ")) << values("s.h5", "n_frames");
}

// Quiet, as a shell's own programs are.
TEST_F(CommandLineOutput, AReaderThatIsGoneIsNoError) {
  write_scenario("s.toml", "receiver.range_m = [1, 2]");
  ASSERT_EQ(program({"run", "s.toml", "-q"}).code, 0);
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.vcd"}).code, 0);
  for (const std::string command :
       {"--help", "--version", "run --help", "help run", "run s.toml -q", "run s.toml -q --json",
        "run s.toml --plan", "merge s.h5 -o sum.h5", "report s.h5 -o r.html", "parts",
        "parts TSSP4056", "decode t.vcd", "decode t.vcd --json", "diff s.h5 s.h5",
        "encode 'IND 011111 OK'", "completion bash", "manual",
        "find s.toml --over receiver.range_m=1:9 -n 8"}) {
    EXPECT_EQ(script("$P " + command + " 2>err | true; echo ${PIPESTATUS[0]}"), "141\n") << command;
    EXPECT_EQ(content(path("err")), "") << command;
    EXPECT_EQ(script("$P " + command + " 2>err >/dev/full; echo $?"), "3\n") << command;
    EXPECT_EQ(content(path("err")),
              "cosys-sim: cannot write to standard output (it is closed or full) redirect it "
              "elsewhere\n")
        << command;
  }
}

TEST_F(CommandLineOutput, AReaderThatIsGoneLeavesTheBaseline) {
  write_scenario("s.toml", "receiver.range_m = [1, 2, 3]");
  EXPECT_EQ(script("$P baseline s.toml -q -o b.h5 2>err | true; echo ${PIPESTATUS[0]}"), "141\n");
  EXPECT_EQ(script("$P check s.toml -q --baseline b.h5 2>&1 >/dev/null; true"), "");
}

// A terminal obeys them, be they of ASCII or C1 in UTF-8.
TEST_F(CommandLineOutput, ControlCharactersStayWithin) {
  const std::string name = "a\x1b[31m\x7f\xc2\x9b", shown = "a?[31m??";
  expect_refused({"run", name}, bad_input, shown + " (no such file) check the path");
}

TEST_F(CommandLineOutput, APointUnderWayIsKept) {
  write_scenario("s.toml", "stop.max_frames = 1e8");
  const Arrivals arrivals(folder());
  Running running = start_program({"run", "s.toml"});
  EXPECT_TRUE(arrivals.wait());
  EXPECT_EQ(running.finish(SIGKILL).code, -SIGKILL);
  EXPECT_GT(std::stoi(values("s.h5", "n_frames")), 0);
  EXPECT_EQ(values("s.h5", "stop_reason"), "2");
}

TEST_F(CommandLineOutput, ResultsAndTracesDoNotReplaceEachOther) {
  write_scenario("s.toml", "receiver.range_m = [1, 2]");
  const Words run = {"run", "s.toml", "-o", "x.h5"}, trace = {"trace", "s.toml", "-o", "x.h5"};
  ASSERT_EQ(program(run).code, 0);
  expect_refused(trace, bad_input,
                 "cannot write x.h5 (it exists and is not a trace of cosys-sim) choose another "
                 "name");
  EXPECT_EQ(program(run).code, 0);
  std::filesystem::remove(path("x.h5"));
  ASSERT_EQ(program(trace).code, 0);
  expect_refused(run, bad_input,
                 "cannot write x.h5 (it exists and is not a result of cosys-sim) choose another "
                 "name");
  EXPECT_EQ(program(trace).code, 0);
}

TEST_F(CommandLineOutput, NamesTooLongAreRefusedInOneLine) {
  write_scenario("s.toml", "receiver.range_m = [1, 2]");
  const std::string name(300, 'a');
  expect_refused({"run", "s.toml", "-o", name}, environment,
                 "cannot write " + name + " (File name too long) choose another place");
}

TEST_F(CommandLineOutput, ATraceThatNoMemoryHoldsIsRefused) {
  write_scenario("s.toml", "receiver.range_m = 1");
  const Outcome o =
      program({"trace", "s.toml", "-o", "t.vcd", "--set", "device.baud=1", "--set",
               "simulation.warmup_messages=100", "--set", "simulation.sample_rate_hz=2e7"});
  EXPECT_EQ(o.code, environment);
  EXPECT_TRUE(o.err.starts_with("cosys-sim: the trace would take ")) << o.err;
  EXPECT_EQ(std::ranges::count(o.err, '\n'), 1) << o.err;
}

// The shell says a line of its own before; the last one is ours.
TEST_F(CommandLineOutput, TheWrapperSaysThatItsFolderIsGone) {
  const Outcome o =
      start_tool("/bin/sh",
                 {"-c", "mkdir gone && cd gone && rmdir ../gone && exec " COSYS_SOURCE_DIR
                        "/cosys-sim --version"})
          .finish();
  EXPECT_EQ(o.code, 2);
  const std::string line =
      "cosys-sim: cannot run here (the folder that you are in was deleted) change to another\n";
  EXPECT_TRUE(o.err.ends_with(line)) << o.err;
}

// Of many rows a terminal would show the last alone; a file or a pipe has them all.
TEST_F(CommandLineOutput, ATerminalIsSparedManyRows) {
  write_scenario(
      "s.toml",
      "simulation.fidelity = \"decision\"\nreceiver.module = \"ideal-coherent\"\n"
      "receiver.ebn0_db = [1, 2, 3, 4, 5, 6, 7, 8, 9]\nled.current_ma = [1, 2, 3, 4, 5]");
  const std::string run = " run s.toml -q -n 8";
  const std::string terminal = script("script -qec \"$P" + run + "\" /dev/null");
  EXPECT_EQ(terminal.find("45 points; --table prints a row for each\r\nFrame loss is least at "),
            0U)
      << terminal;
  EXPECT_LT(std::ranges::count(terminal, '\n'), 20);
  EXPECT_NE(terminal.find("s.h5: digest "), std::string::npos);
  for (const std::string& all :
       {script("$P" + run), script("script -qec \"$P" + run + " --table\" /dev/null")}) {
    EXPECT_GT(std::ranges::count(all, '\n'), 45);
    EXPECT_EQ(all.find("--table"), std::string::npos);
  }
}

// Of a narrow terminal the columns that are read least make room; a pipe has all.
TEST_F(CommandLineOutput, ATableFitsTheTerminal) {
  write_scenario("s.toml", "receiver.range_m = [1, 5]");
  const std::string run = "$P run s.toml -q -n 8";
  const auto table_at = [&](int columns, const std::string& more) {
    return script("script -qec \"stty cols " + std::to_string(columns) + "; " + run + more +
                  "\" /dev/null | head -6");
  };
  const auto widest = [](const std::string& table) {
    std::size_t width = 0;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) width = std::max(width, line.size());
    return width;
  };
  const std::string narrow = table_at(80, "");
  EXPECT_LE(widest(narrow.substr(0, narrow.find("no room"))), 80U + 1) << "with its \\r";
  EXPECT_NE(narrow.find("no room for real time, bit errors, SNR, irradiance, stopped by (--table "
                        "has all)\r\n"),
            std::string::npos)
      << narrow;
  for (const std::string& all : {table_at(200, ""), table_at(80, " --table"), script(run)}) {
    EXPECT_NE(all.find("stopped by"), std::string::npos) << all;
    EXPECT_EQ(all.find("no room"), std::string::npos);
  }
}

}  // namespace
