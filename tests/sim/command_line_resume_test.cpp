// No work is lost: a run that was stopped in any way is gone on with, to the same counts.
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "program.hpp"

namespace {

// Ten kills at random instants, half of them kill -9, each time gone on with; with other numbers
// of threads. The file is written each second.
TEST_F(CommandLine, MeasuredTenKillsChangeNothing) {
  write_scenario("s.toml", "receiver.range_m = \"1:0.5:6\"");
  const Words run{"run", "s.toml", "-n", "2000", "-e", "0", "-q"};
  const std::string whole = digest_of(program(run).out);
  std::filesystem::remove(path("s.h5"));
  std::mt19937 random(7);
  for (int kill = 0; kill < 10; ++kill) {
    Words again = run;
    again.insert(again.end(), {"--resume", "-t", std::to_string(1 + kill % 3)});
    Running running = start_program(again);
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % (kill % 2 == 0 ? 1500 : 400)));
    running.finish(kill % 2 == 0 ? SIGKILL : SIGTERM);
    if (std::filesystem::exists(path("s.h5"))) values("s.h5", "n_frames");  // a whole file
  }
  Words last = run;
  last.emplace_back("--resume");
  const Outcome o = program(last);
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(digest_of(o.out), whole);
  EXPECT_EQ(files(), (std::set<std::string>{"s.toml", "s.h5"}));
}

TEST_F(CommandLine, ResumingAFinishedRunRunsNothing) {
  write_scenario("s.toml", "receiver.range_m = [1, 3]");
  const Outcome first = program({"run", "s.toml", "-q"});
  const std::string elapsed = values("s.h5", "elapsed_s");
  const Outcome again = program({"run", "s.toml", "-q", "--resume"});
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(values("s.h5", "elapsed_s"), elapsed);
}

TEST_F(CommandLine, ResumeStartsWhereThereIsNoFile) {
  write_scenario("s.toml", "receiver.range_m = [1, 3]");
  const Outcome o = program({"run", "s.toml", "-q", "--resume"});
  EXPECT_EQ(o.code, 0);
  EXPECT_EQ(values("s.h5", "n_frames"), "16, 16");
}

TEST_F(CommandLine, ResumeRefusesWhatIsNotTheSameRun) {
  const std::string remedy = " leave out --resume to start anew, or name another -o";
  write_scenario("s.toml", "receiver.range_m = [1, 3]");
  ASSERT_EQ(program({"run", "s.toml", "-q"}).code, 0);
  const std::string before = content(path("s.h5"));
  expect_refused({"run", "s.toml", "-q", "--resume", "--seed", "2"}, 2,
                 "cannot resume s.h5 (it has another seed)" + remedy, "/dev/null");
  expect_refused({"run", "s.toml", "-q", "--resume", "-n", "24"}, 2,
                 "cannot resume s.h5 (it is of another scenario, or of other options)" + remedy,
                 "/dev/null");
  write("s.toml", content(path("s.toml")) + "device.baud = [300, 600]\n");
  expect_refused({"run", "s.toml", "-q", "--resume"}, 2,
                 "cannot resume s.h5 (it is of another scenario, or of other options)" + remedy,
                 "/dev/null");
  EXPECT_EQ(content(path("s.h5")), before);
}

// Any byte of a file may be damaged: it is refused, or the damage is none of the counts.
TEST_F(CommandLine, ResumeRefusesDamage) {  // more in damaged_files_test.cpp
  write_scenario("s.toml", "receiver.range_m = [1, 3]");
  const std::string digest = digest_of(program({"run", "s.toml", "-q"}).out);
  const std::string whole = content(path("s.h5"));
  int refused = 0;
  std::string words;
  for (std::size_t at = 8; at < whole.size(); at += whole.size() / 10) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    write("s.h5", damaged);
    const Outcome o = program({"run", "s.toml", "-q", "--resume"});
    refused += o.code == 2;
    words += program({"diff", "s.h5", "s.h5"}).err;
    EXPECT_TRUE(o.code == 2 || (o.code == 0 && digest_of(o.out) == digest)) << at << o.err;
    EXPECT_LE(std::ranges::count(o.err, '\n'), 1) << o.err;
  }
  EXPECT_GT(refused, 0);
  EXPECT_NE(words.find("the scenario in it cannot be read: it is damaged"), std::string::npos);
  EXPECT_EQ(words.find("correct this line"), std::string::npos) << words;
}

}  // namespace
