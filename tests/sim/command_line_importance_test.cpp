// Importance sampling from the command line: what it prints, writes, goes on with and refuses.
#include <cmath>
#include <csignal>
#include <sstream>
#include <string>
#include <vector>

#include "program.hpp"

namespace {

/// "1.5e-09, _": 1.5e-9 and NaN.
std::vector<double> numbers_in(const std::string& list) {
  std::vector<double> all;
  std::istringstream in(list);
  for (std::string one; std::getline(in, one, ',');)
    all.push_back(one.find('_') == std::string::npos ? std::stod(one) : NAN);
  return all;
}

class Importance : public CommandLine {
 protected:
  Importance() {
    write("s.toml",
          "[receiver]\nmodule = \"ideal-coherent\"\n[simulation]\nmethod = \"importance\"\n"
          "warmup_messages = 1\nsample_rate_hz = 250000\n[sweep]\n"
          "receiver.ebn0_db = [13, 15.5]\n");
  }

  /// But for rounding: sums of shards are added in another order.
  static void expect_equal(const std::string& list, const std::string& other) {
    const std::vector<double> a = numbers_in(list), b = numbers_in(other);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12 * std::abs(b[i]));
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

TEST_F(Importance, MeasuredIsGoneOnWithAndAddedUp) {
  const std::string whole =
      digest_of(program({"run", "s.toml", "-q", "-n", "96", "-e", "0", "-o", "whole.h5"}).out);
  const Words run{"run", "s.toml", "-q", "-n", "96", "-e", "0", "-t", "1"};
  Running running = start_program(run);
  running.line();
  running.finish(SIGTERM);
  Words again = run;
  again.emplace_back("--resume");
  EXPECT_EQ(digest_of(program(again).out), whole);
  for (const char* shard : {"1/2", "2/2", "1/3", "2/3", "3/3"})
    ASSERT_EQ(program({"run", "s.toml", "-q", "-n", "96", "-e", "0", "--shard", shard}).code, 0);
  ASSERT_EQ(program({"merge", "s-1of2.h5", "s-2of2.h5", "-o", "sum.h5"}).code, 0);
  EXPECT_EQ(values("sum.h5", "n_groups"), values("whole.h5", "n_groups"));
  EXPECT_EQ(values("sum.h5", "n_frames_lost"), values("whole.h5", "n_frames_lost"));
  for (const char* ratio : {"ber", "ber_cov", "flr", "flr_ci_high", "sum_dark_likelihood"})
    expect_equal(values("sum.h5", ratio), values("whole.h5", ratio));
  EXPECT_EQ(digest_of(program({"merge", "s-2of3.h5", "s-3of3.h5", "s-1of3.h5", "-o", "a.h5"}).out),
            digest_of(program({"merge", "s-1of3.h5", "s-2of3.h5", "s-3of3.h5", "-o", "b.h5"}).out));
}

TEST_F(Importance, BesideCountedPointsEachIsReportedAsItIs) {
  const Outcome o =
      program({"run", "s.toml", "-q", "-n", "200", "-e", "0", "--set", "receiver.ebn0_db=4,13",
               "--set", "simulation.method=brute-force,importance"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find(" frames lost: "), std::string::npos) << o.out;
  EXPECT_NE(o.out.find(" of 400 frames lost as drawn"), std::string::npos) << o.out;
  EXPECT_NE(o.out.find("brute-force  "), std::string::npos) << o.out;
  EXPECT_NE(values("s.h5", "ber_cov").find("_, 0."), std::string::npos)
      << values("s.h5", "ber_cov");
}

TEST_F(Importance, OfNothingThatFailedNothingIsKnown) {
  const Words few{"run", "s.toml", "-q", "-n", "8", "--set", "receiver.ebn0_db=13", "-o"};
  Words drawn = few, counted = few;
  drawn.emplace_back("drawn.h5");
  counted.insert(counted.end(), {"counted.h5", "--method", "brute-force"});
  ASSERT_EQ(program(drawn).code, 0);
  ASSERT_EQ(program(counted).code, 0);
  const Outcome o = program({"diff", "drawn.h5", "counted.h5"});
  EXPECT_EQ(o.code, 1);
  EXPECT_EQ(o.out,
            "unknown: no point has an estimate in both\n"
            "not compared: a point whose weights give no estimate (alarm weights)\n"
            "they are of other scenarios, options or seeds\n");
}

TEST_F(Importance, RefusesLossesThatCannotBeSharedOut) {
  expect_refused({"run", "s.toml", "--shard", "1/2"}, 2,
                 "--shard 1/2 (what weighted losses are worth cannot be shared out) add "
                 "--max-frame-errors 0");
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
