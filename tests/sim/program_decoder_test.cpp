// Decoders that are programs: every format and mode, and every way to fail.
#include <nlohmann/json.hpp>

#include "edge_decoder.hpp"
#include "program.hpp"

namespace {

class ProgramDecoder : public CommandLine {
 protected:
  void SetUp() override {
    write("weak.toml",
          "[receiver]\nmodule = 'TSSP4056'\nrange_m = 12.4\n[device]\nclock_error_ppm = 40000\n"
          "[simulation]\nfidelity = 'envelope'\nwarmup_messages = 1\n[stop]\nmax_frames = 128\n");
    write("edges.py", edge_decoder);
    static std::string of_mid_bit;
    if (of_mid_bit.empty()) {
      baseline("mid-bit");
      of_mid_bit = content(path("b.h5"));
    }
    write("b.h5", of_mid_bit);
  }

  void baseline(const std::string& decoder) const {
    const Outcome o = program({"baseline", "weak.toml", "-q", "-o", "b.h5", "--decoder", decoder});
    ASSERT_EQ(o.code, 0) << o.err;
  }

  Outcome check(const std::string& command, Words more = {}) const {
    more.insert(more.begin(),
                {"check", "weak.toml", "--baseline", "b.h5", "-q", "--json", "--decoder", command});
    return program(more);
  }

  static nlohmann::json point_of(const Outcome& o) {
    if (o.out.empty()) throw std::runtime_error("nothing but " + o.err);
    return nlohmann::json::parse(o.out)["points"][0];
  }

  /// Frame by frame what the built-in decoder of the baseline makes of them.
  void expect_same(const std::string& command, const Words& more = {}) const {
    Words golden = more;
    golden.push_back("--golden");
    const Outcome o = check(command, golden);
    EXPECT_EQ(o.code, 0) << command << o.err << o.out;
    EXPECT_EQ(point_of(o)["candidate"]["n_frames"], 128);
    EXPECT_GT(point_of(o)["candidate"]["n_frames_lost"], 12);
  }

  void expect_fault(const std::string& command, const std::string& kind, const std::string& what,
                    const Words& more = {}) const {
    const Outcome o = check(command, more);
    EXPECT_EQ(o.code, 1) << command << o.err;
    const auto point = point_of(o);
    EXPECT_EQ(point["verdict"], "failed");
    EXPECT_EQ(point["fault"]["kind"], kind);
    EXPECT_EQ(point["fault"]["what"], what);
    EXPECT_EQ(point["candidate"]["n_frames"], 0) << "that is no frame loss";
  }

  /// A minute that no other process sleeps, be it a test beside this one.
  static std::string own_sleep() { return "sleep 61." + std::to_string(::getpid()); }
  bool anybody_sleeps() const {
    return start_tool("pgrep", {"-f", "^" + own_sleep() + "$"}).finish().code == 0;
  }

  bool is_there(const std::string& tool) const {
    return start_tool("sh", {"-c", "command -v " + tool}).finish().code == 0;
  }
};

TEST_F(ProgramDecoder, InAnotherLanguageIsJudgedLikeOursByEdges) {
  expect_same("/usr/bin/python3 edges.py 0.5");
  expect_same("/usr/bin/python3 edges.py 0.5 < {edges}");
}

TEST_F(ProgramDecoder, MayServeAllCaptures) {
  expect_same("/usr/bin/python3 edges.py 0.5 serve", {"--decoder-mode", "serve"});
  const Outcome late = check("/usr/bin/python3 edges.py 0.6 serve", {"--decoder-mode", "serve"});
  EXPECT_EQ(late.code, 1);
  EXPECT_EQ(point_of(late)["verdict"], "worse");
}

TEST_F(ProgramDecoder, ThatSamplesTenPercentLateIsCaught) {
  EXPECT_EQ(point_of(check("/usr/bin/python3 edges.py 0.6"))["verdict"], "worse");
}

TEST_F(ProgramDecoder, OfSigrokReadsVcdAndSessions) {
  if (!is_there("sigrok-cli")) GTEST_SKIP() << "needs sigrok-cli";
  const std::string uart = " -P uart:rx=rx:baudrate=600 -B uart=rx";
  expect_same("sigrok-cli -i {vcd} -I vcd" + uart);
  // 200 000 samples a second move an edge by 5 us at most, of bits of 1667.
  const auto point = point_of(check("sigrok-cli -i {sr}" + uart, {"--golden"}));
  EXPECT_LE(point["lost_by_candidate_alone"].size() + point["lost_by_baseline_alone"].size(), 3U);
}

TEST_F(ProgramDecoder, MayPrintFramesOfAnyFormat) {
  const std::string decode = std::string(COSYS_PROGRAM) + " decode --baud 600 --uart mid-bit ";
  const std::string frames = " | sed -n 's/^ *[0-9.]* s *ok *//p'";
  for (const char* format : {"{vcd}", "{csv}"})
    expect_same(decode + format + frames, {"--decoder-output", "frames"});
  const auto point =
      point_of(check(decode + "{wav}" + frames, {"--decoder-output", "frames", "--golden"}));
  EXPECT_TRUE(point["fault"].is_null()) << point;
}

TEST_F(ProgramDecoder, MayEndItsLinesAsOtherSystemsDo) {
  expect_same(std::string(COSYS_PROGRAM) +
                  " decode --baud 600 --uart mid-bit {vcd} | sed -n 's/^ *[0-9.]* s *ok *//p' | "
                  "sed 's/$/\\r/'",
              {"--decoder-output", "frames"});
}

TEST_F(ProgramDecoder, ThatServesMayEndInOrder) {
  write("tidy.sh", "/usr/bin/python3 edges.py 0.5 serve; echo $? >> ended");
  expect_same("sh tidy.sh", {"--decoder-mode", "serve", "-t", "1"});
  EXPECT_EQ(content(path("ended")), "0\n");
}

TEST_F(ProgramDecoder, MayTakeTheBytesOfTheScenariosUart) {
  baseline("atmega");
  expect_same("cat {bytes}");
}

TEST_F(ProgramDecoder, ThatFailsIsSaidToHaveFailed) {
  expect_fault("sleep 60", "timeout", "no answer within 0.3 s", {"--decoder-timeout", "0.3s"});
  expect_fault("kill -9 $$", "killed", "killed by signal 9 (Killed)");
  expect_fault("kill -40 $$", "killed", "killed by signal 40 (a real-time signal)");
  expect_fault("echo oops >&2; exit 3", "exit code", "exit code 3");
  const char* nothing =
      "no message in its output, not even an undisturbed one: "
      "does --decoder-output say what it prints?";
  expect_fault("head -c 100000 /dev/urandom", "garbage", nothing);
  expect_fault("echo 'IND 011111 OK'", "garbage", nothing);  // messages, where bytes are expected
  expect_fault("echo 'IND 011111 OK 46'", "garbage",
               "it lost undisturbed messages, beside 128 of 128 frames");
  expect_fault("yes", "garbage", "more than 4 MiB of output");
  expect_fault("true", "garbage", nothing);
  const Words serve{"--decoder-mode", "serve", "--decoder-timeout", "20s"};
  expect_fault("true", "garbage", "it ended without an answer", serve);
  for (const char* answer :
       {"echo hello; cat", "echo -5; cat", "echo 2.5; cat", "printf '3\\nabcd'; cat"})
    expect_fault(answer, "garbage", "its answer is not a number of bytes and so many bytes", serve);
}

TEST_F(ProgramDecoder, IsQuotedWhereItFails) {
  EXPECT_EQ(point_of(check("echo oops >&2; exit 3"))["fault"]["stderr"], "oops\n");
  const Outcome o = program(
      {"check", "weak.toml", "--baseline", "b.h5", "-q", "--decoder", "echo oops >&2; exit 3"});
  EXPECT_NE(o.out.find("the decoder failed: exit code 3\n  | oops\n"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("--decoder 'echo oops >&2; exit 3'"), std::string::npos);
}

TEST_F(ProgramDecoder, ThatIsNotThereIsTheMachinesFault) {
  const Outcome o = check("no-such-decoder --fast");
  EXPECT_EQ(o.code, 3);
  EXPECT_EQ(o.err.find("cosys-sim: the decoder cannot be started (sh: "), 0U) << o.err;
  EXPECT_EQ(o.out, "");
  expect_refused({"check", "weak.toml", "--baseline", "b.h5", "--decoder", "software_serial"}, 2,
                 "--decoder software_serial (no decoder of that name, and no program) did you mean "
                 "software-serial?");
}

TEST_F(ProgramDecoder, MakesNoBaselineIfItFails) {
  const Outcome o = program({"baseline", "weak.toml", "-q", "-o", "new.h5", "--decoder", "exit 3"});
  EXPECT_EQ(o.code, 3);
  EXPECT_FALSE(std::filesystem::exists(path("new.h5")));
}

TEST_F(ProgramDecoder, RefusesWhatCannotBeGiven) {
  const std::string head = "cosys-sim: --decoder ";
  EXPECT_EQ(check("cat {vcd} {sr}").err,
            head + "cat {vcd} {sr} (it asks for two formats) ask for one\n");
  EXPECT_EQ(check("cat {vcd}", {"--decoder-mode", "serve"}).err,
            head + "cat {vcd} (one that serves gets edges on its stdin) leave {vcd} out\n");
}

TEST_F(ProgramDecoder, LeavesNothingBehind) {
  ::setenv("TMPDIR", path("tmp").c_str(), 1);
  std::filesystem::create_directory(path("tmp"));
  expect_same("cat {edges} | /usr/bin/python3 edges.py 0.5");
  EXPECT_TRUE(std::filesystem::is_empty(path("tmp")));
  // One that hangs, and what it started, is gone when the check is.
  expect_fault(own_sleep() + " & " + own_sleep(), "timeout", "no answer within 0.3 s",
               {"--decoder-timeout", "0.3s"});
  EXPECT_FALSE(anybody_sleeps());
  ::unsetenv("TMPDIR");
}

// What is left of a frame is not said to be the least where nobody looked to the end.
TEST_F(ProgramDecoder, IsNotMinimisedOrExplainedAfterASignal) {
  const std::string trial =
      point_of(check("/usr/bin/python3 edges.py 0.6"))["lost_by_candidate_alone"][0].dump();
  for (const char* what : {"--minimise", "--explain"}) {
    const Outcome o =
        program({"check", "weak.toml", "--baseline", "b.h5", "--point", "0", what, trial,
                 "--decoder", "/usr/bin/python3 edges.py 0.6; kill -INT $PPID; sleep 1"});
    EXPECT_EQ(o.code, 130) << o.err;
    EXPECT_EQ(o.out, "");
  }
}

// A baseline that is a program is not started: a decoder of ours takes its place.
TEST_F(ProgramDecoder, IsMinimisedAgainstABuiltInDecoder) {
  const std::string late = "/usr/bin/python3 edges.py 0.6";
  const std::string trial = point_of(check(late))["lost_by_candidate_alone"][0].dump();
  baseline("cat {bytes}");
  const Outcome o = program({"check", "weak.toml", "--baseline", "b.h5", "--point", "0",
                             "--explain", trial, "--decoder", late});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find(late + " loses the frame, mid-bit does not\n"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("mid-bit (built in)\n"), std::string::npos) << o.out;
}

TEST_F(ProgramDecoder, IsEndedByASignal) {
  Running run =
      start_program({"check", "weak.toml", "--baseline", "b.h5", "--decoder", own_sleep()});
  run.await_handler(SIGINT);
  for (int tries = 0; tries < 600 && !anybody_sleeps(); ++tries) ::usleep(100'000);
  EXPECT_EQ(run.finish(SIGINT).code, 130);
  EXPECT_FALSE(anybody_sleeps());
}

}  // namespace
