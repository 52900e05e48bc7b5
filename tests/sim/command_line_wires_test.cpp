// Which wire of a capture decode reads, and how it names them.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "decoded_line.hpp"
#include "program.hpp"

namespace {

/// A VCD of microseconds: a message on each of these wires, later by a millisecond than on the one
/// before, and `others` that edge twice.
std::string dump_of_wires(const std::vector<std::string>& wires, int others) {
  std::string text = "$timescale 1 us $end\n";
  std::multimap<long, std::string> changes;
  const dsp::LogicTrace line = message_line(600);
  const auto add = [&](const std::string& name) {
    const std::string code = fmt::format("n{}", changes.size());
    text += fmt::format("$var wire 1 {} {} $end\n", code, name);
    changes.emplace(0, "1" + code);
    return code;
  };
  for (std::size_t i = 0; i < wires.size(); ++i) {
    const std::string code = add(wires[i]);
    bool level = true;
    for (const dsp::Seconds edge : line.edges()) {
      level = !level;
      changes.emplace(std::lround(edge.value * 1e6) + 1000 * static_cast<long>(i),
                      (level ? "1" : "0") + code);
    }
  }
  for (int i = 0; i < others; ++i) {
    const std::string code = add(fmt::format("w{}", i));
    changes.emplace(50 + i, "0" + code);
    changes.emplace(900 + i, "1" + code);
  }
  text += "$enddefinitions $end\n";
  for (const auto& [at, change] : changes) text += fmt::format("#{}\n{}\n", at, change);
  return text + "#400000\n";
}

TEST_F(CommandLine, DecodeKnowsAVectorOfOneBit) {
  write("t.vcd", dump_of_wires({"a", "RX [0:0]"}, 0));
  const Outcome o = program({"decode", "t.vcd"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find(fmt::format("channel RX[0:0] ({0} edges), not a ({0});",
                                   message_line(600).edges().size())),
            std::string::npos)
      << o.out;
  EXPECT_EQ(program({"decode", "t.vcd", "--wire", "rx"}).out, o.out);
  write("t.vcd", dump_of_wires({"rx [0:0]", "RX"}, 0));
  EXPECT_NE(program({"decode", "t.vcd", "--wire", "rx"}).out.find("channel RX ("),
            std::string::npos);
  write("t.vcd", dump_of_wires({"a", "RX [1:0]"}, 0));
  EXPECT_EQ(program({"decode", "t.vcd", "--wire", "rx"}).code, 2);
}

// What was sent would be read as if it had been heard.
TEST_F(CommandLine, DecodeDoubtsTheOthersWhereNothingIsOnRx) {
  write_scenario("s.toml", "receiver.range_m = [60]");
  for (const char* file : {"t.vcd", "t.csv", "t.sr", "t.h5"}) {
    ASSERT_EQ(program({"trace", "s.toml", "-o", file}).code, 0);
    const Outcome o = program({"decode", file});
    EXPECT_EQ(o.code, 4) << file << o.out;
    EXPECT_EQ(o.err,
              "cosys-sim: nothing is on rx, so tx was read (nothing was heard, or it is not "
              "connected) say --channel\n");
    EXPECT_EQ(program({"decode", file, "--channel", "tx"}).code, 0) << file;
  }
}

TEST_F(CommandLine, DecodeNamesThePlacesThatEndAsAsked) {
  write("t.vcd", dump_of_wires({"a.dut.rx", "b.dut.rx"}, 0));
  expect_refused(
      {"decode", "t.vcd", "--wire", "dut.rx"}, 2,
      "--wire dut.rx is 2 wires of t.vcd (their places end so) use a.dut.rx or b.dut.rx");
}

TEST_F(CommandLine, DecodePrefersMessagesAndWhatIsReceived) {
  const auto channel_of = [&](const std::string& text) {
    write("t.vcd", text);
    const Outcome o = program({"decode", "t.vcd", "--json"});
    EXPECT_EQ(o.code, 0) << o.err;
    return line_facts(o.out).at("capture").at("channel").get<std::string>();
  };
  EXPECT_EQ(channel_of(dump_of_wires({"tx", "line"}, 0)), "line");
  EXPECT_EQ(channel_of(dump_of_wires({"uart_txd", "line"}, 0)), "line");
  // What is sent is better than what makes no sense.
  const std::string declared = "$enddefinitions";
  std::string clocked = dump_of_wires({"tx"}, 0);
  clocked.insert(clocked.find(declared), "$var wire 1 c clk $end\n");
  clocked.insert(clocked.find("#0\n") + 3, "0c\n");
  std::string edges;
  for (int i = 1; i < 200; ++i) edges += fmt::format("#{} {}c\n", 400'000 + 100 * i, i % 2);
  EXPECT_EQ(channel_of(clocked + edges), "tx");
}

TEST_F(CommandLine, DecodeSaysHowManyWiresItDidNotLookAt) {
  write("t.vcd", dump_of_wires({"line"}, 130));
  const Outcome o = program({"decode", "t.vcd", "--json"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_EQ(line_facts(o.out).at("capture").at("channel"), "line");
  EXPECT_EQ(line_facts(o.out).at("capture").at("assumed"),
            nlohmann::json::array({"no line on the other 31 channels with edges"}));
}

// A clock has more edges before the message than are looked at of a pipe.
TEST_F(CommandLine, DecodeLooksPastAClock) {
  std::string text =
      "$timescale 1 ns $end $var wire 1 c clk $end $var wire 1 l line $end\n$enddefinitions "
      "$end\n#0 1l\n";
  for (int i = 0; i < 600'000; ++i) text += fmt::format("#{} {}c\n", 10 * i, i % 2);
  const dsp::LogicTrace line = message_line(600);
  bool level = true;
  for (const dsp::Seconds edge : line.edges()) {
    level = !level;
    text += fmt::format("#{:.0f} {}l\n", 6e6 + edge.value * 1e9, level ? 1 : 0);
  }
  write("t.vcd", text);
  const Outcome o = program({"decode", "t.vcd"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find("channel line (98 edges), not clk (599999);"), std::string::npos) << o.out;
  EXPECT_NE(program({"decode", "t.vcd", "--baud", "600"}).out.find("channel line ("),
            std::string::npos);
  const Outcome piped =
      start_tool("sh", {"-c", std::string("cat t.vcd | ") + COSYS_PROGRAM + " decode -"}).finish();
  EXPECT_EQ(piped.code, 4);
  EXPECT_NE(piped.err.find("no line is found"), std::string::npos) << piped.err;
}

// A level that does not last, as simulators dump within one instant.
TEST_F(CommandLine, DecodeFindsALineThroughChangesThatTakeNoTime) {
  std::string text =
      "$timescale 1 us $end $var wire 1 a a $end $var wire 1 b b $end\n$enddefinitions $end\n#0 1a "
      "1b\n";
  const dsp::LogicTrace line = message_line(1100);
  for (int i = 1; i < 200; ++i) text += fmt::format("#{} {}a\n", 104 * i, (i + 1) % 2);
  bool level = true;
  for (const dsp::Seconds edge : line.edges()) {
    level = !level;
    text += fmt::format("#{0:.0f} {1}b {2}b {1}b\n", 30000 + edge.value * 1e6, level ? 1 : 0,
                        level ? 0 : 1);
  }
  write("t.vcd", text + "#400000\n");
  const Outcome o = program({"decode", "t.vcd"});
  EXPECT_EQ(o.code, 0) << o.err;
  EXPECT_NE(o.out.find(" ok "), std::string::npos) << o.out;
}

TEST_F(CommandLine, DecodeTakesNamesAsItShowsThem) {
  write("t.vcd", dump_of_wires({"\\bus[3].line", "Empf\u00e4nger"}, 0));
  for (const char* name : {"\\\\bus[3].line", "\\bus[3].line", "Empf\u00e4nger"}) {
    const Outcome o = program({"decode", "t.vcd", "--wire", name});
    EXPECT_EQ(o.code, 0) << o.err;
    EXPECT_NE(o.out.find("Empf\u00e4nger"), std::string::npos) << o.out;
  }
}

}  // namespace
