// Importance sampling from the command line: what it prints, writes, goes on with and refuses.
#include <csignal>

#include "program.hpp"

namespace {

class Importance : public CommandLine {
 protected:
  Importance() {
    write("s.toml",
          "[receiver]\nmodule = \"ideal-coherent\"\n[simulation]\nmethod = \"importance\"\n"
          "warmup_messages = 1\nsample_rate_hz = 250000\n[sweep]\n"
          "receiver.ebn0_db = [13, 15.5]\n");
  }
};

TEST_F(Importance, PrintsAndKeepsRatios) {
  const Outcome o = program({"run", "s.toml", "-q", "-n", "160", "-e", "0"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find(" of 320 frames lost as drawn; ratios are weighted to what comes by nature"),
            std::string::npos)
      << o.out;
  EXPECT_EQ(o.out.find("frame loss crosses"), std::string::npos);
  EXPECT_EQ(values("s.h5", "n_groups"), "20, 20");
  EXPECT_EQ(values("s.h5", "alarms"), "0, 0");
  const std::string ber = values("s.h5", "ber");
  EXPECT_NE(ber.find("e-06"), std::string::npos) << ber;
  EXPECT_NE(ber.find("e-09"), std::string::npos) << ber;
  EXPECT_EQ(program({"run", "s.toml", "-q", "-n", "160", "-e", "0", "--resume"}).out, o.out);
}

TEST_F(Importance, OfTheOptionIsThatOfTheKey) {
  const Words run{"run", "s.toml", "-q", "-n", "40", "--set", "receiver.ebn0_db=8", "--method"};
  Words counted = run, drawn = run;
  counted.insert(counted.end(), {"brute-force", "-o", "counted.h5"});
  drawn.insert(drawn.end(), {"importance", "-o", "drawn.h5"});
  ASSERT_EQ(program(counted).code, 0);
  ASSERT_EQ(program(drawn).code, 0);
  EXPECT_EQ(values("drawn.h5", "n_groups"), "5");
  EXPECT_NE(program({"diff", "counted.h5", "drawn.h5"}).out.find("compatible"), std::string::npos);
  expect_refused(
      {"run", "s.toml", "--method", "guess"}, 2,
      "simulation.method = \"guess\" in --set (the method of counting errors is one of a "
      "list) use brute-force or importance");
}

TEST_F(Importance, IsGoneOnWithAndAddedUp) {
  const std::string whole =
      digest_of(program({"run", "s.toml", "-q", "-n", "400", "-e", "0", "-o", "whole.h5"}).out);
  const Words run{"run", "s.toml", "-q", "-n", "400", "-e", "0", "-t", "1"};
  Running running = start_program(run);
  running.line();
  running.finish(SIGTERM);
  Words again = run;
  again.emplace_back("--resume");
  EXPECT_EQ(digest_of(program(again).out), whole);
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(program({"run", "s.toml", "-q", "-n", "400", "-e", "0", "--shard", shard}).code, 0);
  ASSERT_EQ(program({"merge", "s-1of2.h5", "s-2of2.h5", "-o", "sum.h5"}).code, 0);
  EXPECT_EQ(values("sum.h5", "n_groups"), values("whole.h5", "n_groups"));
  EXPECT_EQ(values("sum.h5", "n_frames_lost"), values("whole.h5", "n_frames_lost"));
}

TEST_F(Importance, RefusesToTraceAndToFind) {
  expect_refused({"trace", "s.toml", "-o", "t.vcd"}, 2,
                 "simulation.method = \"importance\" (trace shows trials as they come) add --set "
                 "simulation.method=brute-force");
  expect_refused({"find", "s.toml", "--over", "receiver.ebn0_db"}, 2,
                 "simulation.method = \"importance\" (find tells losses from a level frame by "
                 "frame) add --set simulation.method=brute-force");
}

}  // namespace
