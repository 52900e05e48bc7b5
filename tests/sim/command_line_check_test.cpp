// cosys-sim baseline and check, as users and their CI see them.
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "text_lines.hpp"

namespace {

using sim::last_line;

class CheckCommand : public CommandLine {
 protected:
  void SetUp() override {
    write("weak.toml", scenario("[0, 40000]"));
    static std::string of_weak;
    if (of_weak.empty()) {
      make_baseline("b.h5", {});
      of_weak = content(path("b.h5"));
    }
    write("b.h5", of_weak);
  }

  static std::string scenario(const std::string& errors_ppm) {
    return "[receiver]\nmodule = 'TSSP4056'\nrange_m = 12.4\n"
           "[simulation]\nfidelity = 'envelope'\nwarmup_messages = 1\n"
           "[stop]\nmax_frames = 600\n[sweep]\ndevice.clock_error_ppm = " +
           errors_ppm + "\n";
  }

  void make_baseline(const std::string& file, Words options) const {
    options.insert(options.begin(), {"baseline", "weak.toml", "-q", "-o", file});
    const Outcome o = program(options);
    ASSERT_EQ(o.code, 0) << o.err;
  }

  Outcome check(Words options, const std::string& baseline = "b.h5") const {
    options.insert(options.begin(), {"check", "weak.toml", "--baseline", baseline, "-q"});
    return program(options);
  }

  static nlohmann::json json_of(const Outcome& o) { return nlohmann::json::parse(o.out); }
};

TEST_F(CheckCommand, PassesTheBaselinesOwnDecoder) {
  const Outcome o = check({});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(last_line(o.out), "passed: 2 points\n");
  EXPECT_NE(o.out.find("\npower: a decoder that loses 1.5 times as many is found"),
            std::string::npos);
  EXPECT_EQ(o.err, "");
}

TEST_F(CheckCommand, FindsAWorseOneAndSaysHowToLookAtIt) {
  const Outcome o = check({"--decoder", "edge-timing"});
  EXPECT_EQ(o.code, 1);
  EXPECT_EQ(last_line(o.out).find("worse: "), 0U) << o.out;
  const std::string again =
      "again: cosys-sim check weak.toml --point 0 --baseline b.h5 --decoder "
      "edge-timing\n";
  EXPECT_NE(o.out.find(again), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("its waveform: cosys-sim trace weak.toml --point 0 --trial "),
            std::string::npos);
  EXPECT_EQ(check({"--decoder", "edge-timing", "--point", "0"}).code, 1);
}

TEST_F(CheckCommand, RepeatsAllOptionsThatCount) {
  std::filesystem::create_directory(path("my parts"));
  const Outcome o = check({"--decoder", "edge-timing", "-n", "512", "--parts", "my parts",
                           "--alpha", "0.00123456789", "--set", "stop.max_frames=600"});
  const std::string again =
      " --baseline b.h5 --decoder edge-timing --alpha 0.00123456789 -n 512 --set "
      "stop.max_frames=600 --parts 'my parts'\n";
  EXPECT_NE(o.out.find(again), std::string::npos) << o.out;
  const std::string trace = " --set stop.max_frames=600 --parts 'my parts' -o frame";
  EXPECT_NE(o.out.find(trace), std::string::npos) << o.out;
}

TEST_F(CheckCommand, TakesAtLeastOneFrame) {
  for (const std::string none : {"0", "", "1.5", "-1", "1e10"})
    expect_refused({"check", "weak.toml", "--baseline", "b.h5", "-n", none}, 2,
                   "--max-frames: " + none +
                       " is no whole number from 1 to 1000000000 (wrong usage) see cosys-sim check "
                       "--help");
  EXPECT_EQ(check({"-n", "6e1", "--json"}).out, check({"-n", "60", "--json"}).out);
  expect_refused(
      {"check", "weak.toml", "--baseline", "b.h5", "--point", ""}, 2,
      "--point:  is not a whole number, counted from 0 (wrong usage) see cosys-sim check "
      "--help");
}

TEST_F(CheckCommand, SaysThatFewFramesLeaveItOpen) {
  const Outcome o = check({"-n", "20", "--decoder", "mid-bit"});
  EXPECT_EQ(o.code, 4);
  EXPECT_NE(o.out.find(" frames would tell\n"), std::string::npos);
  EXPECT_EQ(last_line(o.out), "inconclusive: 2 of 2 points would take more frames\n");
}

TEST_F(CheckCommand, GoldenFailsForOneFrame) {
  EXPECT_EQ(check({"--golden"}).code, 0);
  const Outcome o = check({"--golden", "--decoder", "mid-bit", "--json"});
  EXPECT_EQ(o.code, 1);
  const auto json = json_of(o);
  for (const auto& point : json["points"]) {
    EXPECT_EQ(point["candidate"]["n_frames"], 600);
    EXPECT_GT(point["lost_by_candidate_alone"].size() + point["lost_by_baseline_alone"].size(), 0U);
  }
}

TEST_F(CheckCommand, SaysTheSameForAnyNumberOfThreads) {
  const Words words{"--decoder", "edge-timing", "--json"};
  Words one = words, three = words;
  one.insert(one.end(), {"-t", "1"});
  three.insert(three.end(), {"-t", "3"});
  EXPECT_EQ(check(one).out, check(three).out);
}

// The frames that a check lists are those that trace shows: each is lost by the decoder that lost
// it, and not by the other, where no message before it leaves a line unended.
TEST_F(CheckCommand, ListsFramesThatTraceShows) {
  const auto point =
      json_of(check({"--decoder", "edge-timing", "--json", "--point", "0"}))["points"][0];
  int as_said = 0, n = 0;
  for (const int trial : point["lost_by_candidate_alone"]) {
    if (++n > 10) break;
    ASSERT_EQ(program({"trace", "weak.toml", "--trial", std::to_string(trial), "-o", "t.vcd"}).code,
              0);
    const auto delivered = [&](const char* uart) {
      const std::string text =
          program({"decode", "t.vcd", "--baud", "600", "--uart", uart, "--json"}).out;
      std::size_t count = 0;
      for (std::size_t at = 0; (at = text.find("\"ok\"", at)) != std::string::npos; ++at) ++count;
      return count;
    };
    as_said += delivered("edge-timing") < delivered("atmega");
  }
  EXPECT_GE(as_said, 7);
}

TEST_F(CheckCommand, ExplainsAFrameAndFindsTheLeastThatBreaksIt) {
  const auto point =
      json_of(check({"--decoder", "edge-timing", "--json", "--point", "0"}))["points"][0];
  const std::string trial = point["lost_by_candidate_alone"][0].dump();
  const Words frame{"--decoder", "edge-timing", "--point", "0"};
  Words explain = frame, minimise = frame;
  explain.insert(explain.end(), {"--explain", trial});
  minimise.insert(minimise.end(), {"--minimise", trial});
  const Outcome story = check(explain), least = check(minimise);
  EXPECT_EQ(story.code, 0) << story.err;
  EXPECT_EQ(story.out.find("weak, device.clock_error_ppm = 0, trial " + trial + ": "), 0U)
      << story.out;
  EXPECT_NE(story.out.find("\natmega: delivered\n"), std::string::npos);
  for (const std::string part :
       {"\n  light      ", " enough: edge-timing loses the frame, atmega does not\n",
        "as a test vector in C: --minimise "})
    EXPECT_NE(story.out.find(part), std::string::npos) << part << story.out;
  EXPECT_EQ(least.code, 0) << least.err;
  EXPECT_NE(least.out.find(" enough: edge-timing loses the frame, atmega does not\n"),
            std::string::npos);
  EXPECT_NE(least.out.find("static const unsigned long changes_us[] = {\n"), std::string::npos);
  expect_refused({"check", "weak.toml", "--baseline", "b.h5", "--explain", "3"}, 2,
                 "--explain and --minimise (they are of one frame of one point) say which by "
                 "--point");
  expect_refused({"check", "weak.toml", "--baseline", "b.h5", "--point", "0", "--minimise", trial},
                 2,
                 "--minimise " + trial +
                     " (it is no frame that atmega loses, or accepts wrongly, and atmega does not) "
                     "take one that the check lists as one of the candidate alone");
  // Frames are counted in 32 bits, markers behind them included.
  for (const std::string option : {"--explain", "--minimise"})
    expect_refused(
        {"check", "weak.toml", "--baseline", "b.h5", "--point", "0", option, "1000000000"}, 2,
        option +
            ": 1000000000 is no number from 0 to 999999999 (wrong usage) see "
            "cosys-sim check --help");
}

TEST_F(CheckCommand, WritesJunitThatIsValid) {
  if (start_tool("xmllint", {"--version"}).finish().code != 0) GTEST_SKIP() << "needs xmllint";
  for (const Words& options : {Words{}, Words{"--decoder", "edge-timing"}, Words{"-n", "20"}}) {
    Words all = options;
    all.insert(all.end(), {"--junit", "f.xml"});
    check(all);
    tool("xmllint", {"--noout", "--schema", COSYS_SOURCE_DIR "/tests/sim/junit.xsd", "f.xml"});
    if (const char* schema = std::getenv("COSYS_JUNIT_SCHEMA"))
      tool("xmllint", {"--noout", "--schema", schema, "f.xml"});
  }
  EXPECT_EQ(tool("xmllint", {"--xpath", "count(//skipped)", "f.xml"}), "2\n");
  check({"--decoder", "edge-timing", "--junit", "f.xml"});
  const std::string body = tool("xmllint", {"--xpath", "string(//testcase[1]/failure)", "f.xml"});
  for (const char* part : {"candidate: ", " frames lost, ", "again: cosys-sim check weak.toml"})
    EXPECT_NE(body.find(part), std::string::npos) << body;
}

TEST_F(CheckCommand, RefusesAnotherScenario) {
  write("weak.toml", scenario("[0, 40000]") + "[led]\ncurrent_ma = 99\n");
  expect_refused({"check", "weak.toml", "--baseline", "b.h5"}, 2,
                 "weak, device.clock_error_ppm = 0 (the baseline b.h5 is of another scenario: here "
                 "led.current_ma = 99, there led.current_ma = 100) give the one that it was made "
                 "of, or make it anew with cosys-sim baseline");
  write("weak.toml", scenario("[0, 1]"));
  expect_refused({"check", "weak.toml", "--baseline", "b.h5"}, 2,
                 "weak, device.clock_error_ppm = 1 (the baseline b.h5 has no such point) make it "
                 "anew with cosys-sim baseline");
  write("weak.toml", "# other words, the same scenario\n" + scenario("[0, 40000]"));
  EXPECT_EQ(check({}).code, 0);
}

TEST_F(CheckCommand, RefusesWhatIsNoBaseline) {
  write("x.h5", "no");
  expect_refused({"check", "weak.toml", "--baseline", "x.h5"}, 2,
                 "x.h5 (not an HDF5 file that can be read) choose another file");
  ASSERT_EQ(program({"run", "weak.toml", "-n", "8", "-q", "-o", "r.h5"}).code, 0);
  expect_refused({"check", "weak.toml", "--baseline", "r.h5"}, 2,
                 "r.h5 (not a baseline of cosys-sim) make one with cosys-sim baseline");
  expect_refused({"check", "weak.toml", "--baseline", "b.h5", "--decoder", "atmgea"}, 2,
                 "--decoder atmgea (no decoder of that name, and no program) did you mean atmega?");
  expect_refused(
      {"baseline", "weak.toml", "-o", "weak.toml"}, 2,
      "cannot write weak.toml (it exists and is not a baseline of cosys-sim) choose another "
      "name");
  expect_refused({"check", "weak.toml", "--baseline", "b.h5", "--point", "2"}, 2,
                 "--point 2 (no scenario has so many points) points are counted from 0");
}

TEST_F(CheckCommand, RefusesMoreFramesThanCanBeKept) {
  expect_refused({"baseline", "weak.toml", "-n", "1e9", "-o", "n.h5"}, 2,
                 "stop.max_frames = 1000000000 in weak.toml (the outcome of each is kept) take "
                 "10000000 at most");
}

TEST_F(CheckCommand, TruncatedBaselinesAreRefused) {
  const std::string whole = content(path("b.h5"));
  for (std::size_t size = 0; size < whole.size(); size += whole.size() / 14) {
    std::ofstream(path("t.h5"), std::ios::binary) << whole.substr(0, size);
    EXPECT_EQ(check({}, "t.h5").code, 2) << size;
  }
}

TEST_F(CheckCommand, BaselinesAreRenewedAndSayWhatIsOther) {
  const std::string before = values("b.h5", "n_frames_lost");
  const Outcome same = program({"baseline", "-o", "b.h5", "-q"});
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_NE(same.out.find(" before, 0 of 600 frames came out otherwise; a check finds "),
            std::string::npos)
      << same.out;
  EXPECT_EQ(values("b.h5", "n_frames_lost"), before);
  const Outcome other = program({"baseline", "-o", "b.h5", "-q", "--decoder", "mid-bit"});
  EXPECT_EQ(other.out.find(" 0 of 600 frames came"), std::string::npos) << other.out;
  EXPECT_NE(values("b.h5", "n_frames_lost"), before);
  expect_refused({"baseline", "-o", "new.h5"}, 2,
                 "no scenario (new.h5 is no baseline to renew) give one: cosys-sim baseline "
                 "scenarios/quickstart.toml -o B.h5");
}

TEST_F(CheckCommand, ABaselineSaysWhatACheckOfItFinds) {
  const Outcome few = program({"baseline", "weak.toml", "-n", "256", "-q", "-o", "few.h5"});
  EXPECT_NE(few.out.find(" of 256 frames lost; a check finds "), std::string::npos) << few.out;
  EXPECT_NE(few.out.find("\nfound: in 95 % of checks\n2 of 2 points may leave an equal decoder "
                         "inconclusive: --detect 1.5x plays as many frames as it takes\n"),
            std::string::npos)
      << few.out;
}

TEST_F(CheckCommand, ABaselineHasTheFramesThatFindWhatItIsToDetect) {
  const Outcome o = program({"baseline", "weak.toml", "-n", "256", "-q", "-o", "d.h5", "--detect",
                             "1.3x", "--power", ".9"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("\nfound: in 90 % of checks with --worse-than 1.3\n"), std::string::npos);
  EXPECT_EQ(o.out.find("inconclusive"), std::string::npos) << o.out;
  const Outcome same =
      program({"check", "weak.toml", "--baseline", "d.h5", "-q", "--worse-than", "1.3"});
  EXPECT_EQ(last_line(same.out), "passed: 2 points\n");
  const Outcome renewed = program({"baseline", "-o", "d.h5", "-q"});
  EXPECT_EQ(renewed.out.find(" of 256 frames lost"), std::string::npos) << renewed.out;
  expect_refused({"baseline", "weak.toml", "-o", "d.h5", "--detect", "x"}, 2,
                 "--detect: x is no number from 1.01 to 100 (wrong usage) see cosys-sim baseline "
                 "--help");
}

// 600 frames end in the midst of a capture, which is played again with those that follow.
TEST_F(CheckCommand, ABaselineThatGrowsIsThatOfSoManyFrames) {
  ASSERT_EQ(program({"baseline", "weak.toml", "-q", "-o", "d.h5", "--detect", "1.3x"}).code, 0);
  const Outcome same =
      program({"check", "weak.toml", "--baseline", "d.h5", "-q", "--golden", "--json"});
  EXPECT_EQ(same.code, 0) << same.err;
  for (const auto& point : json_of(same)["points"]) {
    EXPECT_GT(point["candidate"]["n_frames"], 600);
    EXPECT_EQ(point["pairing"], "stored");
  }
}

TEST_F(CheckCommand, ABaselineStartsNoProgram) {
  write("mine.sh", "#!/bin/sh\ntouch started\ncat\n");
  ASSERT_EQ(program({"baseline", "weak.toml", "-n", "128", "-q", "-o", "p.h5", "--decoder",
                     "sh mine.sh <{bytes}"})
                .code,
            0);
  std::filesystem::remove(path("started"));
  const std::string refusal =
      "no --decoder (the baseline's is a program, which no file may start) say it: --decoder 'sh "
      "mine.sh <{bytes}'";
  expect_refused({"check", "weak.toml", "--baseline", "p.h5"}, 2, refusal);
  expect_refused({"baseline", "-o", "p.h5"}, 2, refusal);
  EXPECT_FALSE(std::filesystem::exists(path("started")));
  EXPECT_EQ(program({"baseline", "-o", "p.h5", "-q", "--decoder", "sh mine.sh <{bytes}"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(path("started")));
}

TEST_F(CheckCommand, ABaselineOfSeveralScenariosIsOneFile) {
  write("two.toml", scenario("[0]"));
  ASSERT_EQ(program({"baseline", "weak.toml", "two.toml", "-n", "128", "-q", "-o", "both.h5"}).code,
            0);
  const Outcome o =
      program({"check", "two.toml", "weak.toml", "--baseline", "both.h5", "--json", "-q"});
  ASSERT_NE(o.code, 2) << o.err;
  EXPECT_EQ(json_of(o)["points"].size(), 3U);
  EXPECT_EQ(json_of(o)["points"][0]["name"], "two, device.clock_error_ppm = 0");
}

TEST_F(CheckCommand, ASignalLeavesTheOldBaselineAlone) {
  const std::string before = content(path("b.h5"));
  Running run = start_program({"baseline", "weak.toml", "-n", "3000000", "-q", "-o", "b.h5"});
  run.await_handler(SIGINT);
  const Outcome o = run.finish(SIGINT);
  EXPECT_EQ(o.code, 130);
  EXPECT_NE(o.err.find("interrupted (by a signal)"), std::string::npos) << o.err;
  EXPECT_EQ(content(path("b.h5")), before);
}

}  // namespace
