// `cosys-sim fit --plan` as users see it.
#include <algorithm>
#include <cmath>

#include "program.hpp"
#include "sim/fit/bench_notes.hpp"
#include "sim/fit/plan_text.hpp"

namespace {

class FitCommand : public CommandLine {};

const std::set<std::string> bench{"bench",        "bench/README.txt",        "bench/plan.txt",
                                  "bench/sketch", "bench/sketch/sketch.ino", "bench/wiring.svg"};

TEST_F(FitCommand, WritesABench) {
  const Outcome o = program({"fit", "--plan", "-o", "bench"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(o.err, "");
  EXPECT_EQ(o.out, "bench/plan.txt\nbench/sketch/sketch.ino\nbench/wiring.svg\nbench/README.txt\n");
  EXPECT_EQ(files(), bench);
  EXPECT_GT(sim::read_plan(path("bench/plan.txt")).steps.size(), 100U);
  const std::string notes = content(path("bench/README.txt"));
  EXPECT_LE(std::ranges::count(notes, '\n'), 14);
  EXPECT_NE(notes.find("0.50 m"), std::string::npos) << notes;
  EXPECT_NE(notes.find("cosys-sim fit capture.csv -o modules/mine.toml\n"), std::string::npos);
  const auto first = sim::first_level_in(content(path("bench/plan.txt")));
  ASSERT_TRUE(first);
  EXPECT_NEAR(*first, 0.12 * std::pow(10, 54.0 / 20), 0.1) << "54 dB above Emin";
}

// A recording that was made of its plan would be read by another one.
TEST_F(FitCommand, LosesNoBenchByAnother) {
  ASSERT_EQ(program({"fit", "--plan", "-o", "bench"}).code, 0);
  const std::string before = content(path("bench/plan.txt"));
  EXPECT_EQ(program({"fit", "--plan", "-o", "bench"}).code, 0) << "the same again";
  expect_refused(
      {"fit", "--plan", "-o", "bench", "--minutes", "1", "--module", "tsop38456"}, bad_input,
      "cannot write bench/plan.txt (another one is there) choose another folder, or remove it");
  EXPECT_EQ(files(), bench);
  EXPECT_EQ(content(path("bench/plan.txt")), before);
  expect_refused({"fit", "--plan", "-o", "bench.toml"}, bad_input,
                 "--output bench.toml (it is to be a folder) name one, such as bench");
}

TEST_F(FitCommand, ReplacesNoSketchThatSomebodyChanged) {
  ASSERT_EQ(program({"fit", "--plan", "-o", "bench"}).code, 0);
  std::string mine = content(path("bench/sketch/sketch.ino"));
  const std::string pin = "running_pin = 1 << 5";
  mine.replace(mine.find(pin), pin.size(), "running_pin = 1 << 4");
  write("bench/sketch/sketch.ino", mine);
  expect_refused({"fit", "--plan", "-o", "bench"}, bad_input,
                 "cannot write bench/sketch/sketch.ino (another one is there) choose another "
                 "folder, or remove it");
  EXPECT_EQ(content(path("bench/sketch/sketch.ino")), mine);
}

TEST_F(FitCommand, TheDrawingIsWellFormed) {
  if (start_tool("xmllint", {"--version"}).finish().code != 0) GTEST_SKIP() << "needs xmllint";
  ASSERT_EQ(program({"fit", "--plan", "-o", "bench"}).code, 0);
  tool("xmllint", {"--noout", "bench/wiring.svg"});
}

TEST_F(FitCommand, ReplacesNoFileOfOthers) {
  std::filesystem::create_directories(path("bench/sketch"));
  for (const std::string name : {"bench/plan.txt", "bench/sketch/sketch.ino", "bench/README.txt"}) {
    write(name, "mine\n");
    const Outcome o = program({"fit", "--plan", "-o", "bench"});
    EXPECT_EQ(o.code, bad_input);
    EXPECT_NE(o.err.find(name), std::string::npos) << o.err;
    EXPECT_EQ(content(path(name)), "mine\n");
    std::filesystem::remove(path(name));
  }
  EXPECT_EQ(files(), (std::set<std::string>{"bench", "bench/sketch"}));
}

TEST_F(FitCommand, SaysWhatItWants) {
  const std::string how = "write cosys-sim fit CAPTURE, or cosys-sim fit --plan -o FOLDER";
  expect_refused({"fit"}, bad_input, "fit (it is given no capture, and no --plan) " + how);
  expect_refused({"fit", "--plan", "x.txt"}, bad_input,
                 "--plan x.txt (no capture of it is given) " + how);
  expect_refused({"fit", "--plan"}, bad_input,
                 "fit --plan (it has no folder to write to) write cosys-sim fit --plan -o FOLDER");
  for (const std::string minutes : {"0.9", "31", "nan"})
    expect_refused({"fit", "--plan", "-o", "bench", "--minutes", minutes}, bad_input,
                   "--minutes: " + minutes +
                       " is no number from 1 to 30 (wrong usage) see cosys-sim fit --help");
  for (const Words& option :
       {Words{"--irradiance", "1"}, Words{"--drive", "D7"}, Words{"--json"}}) {
    Words words{"fit", "--plan", "-o", "bench"};
    words.insert(words.end(), option.begin(), option.end());
    expect_refused(
        words, bad_input,
        option.front() + " without a capture (it is for captures) leave it out, or name a capture");
  }
}

TEST_F(FitCommand, RefusesAModuleThatItDoesNotKnow) {
  const Outcome o = program({"fit", "--plan", "-o", "bench", "--module", "TSOP4855"});
  EXPECT_EQ(o.code, bad_input);
  EXPECT_NE(o.err.find("--module TSOP4855"), std::string::npos) << o.err;
  EXPECT_TRUE(files().empty());
}

}  // namespace
