#include "sim/trace/vcd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include "protocol/uart.hpp"
#include "vcd_reading.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::LogicTrace;
using dsp::Seconds;
using Random = std::mt19937_64;

std::string written(const std::vector<VcdWire>& wires, Seconds duration) {
  std::ostringstream out;
  write_vcd(out, wires, duration);
  return out.str();
}

LogicTrace at_us(bool initial, const std::vector<double>& edges, double end) {
  LogicTrace trace(initial);
  for (const double edge : edges) trace.add_edge(Seconds(edge * 1e-6));
  trace.observe_until(Seconds(end * 1e-6));
  return trace;
}

// --- what is written

TEST(Vcd, WritesInitialLevelsThenChangesThenTheLastLevelsAgain) {
  const LogicTrace tx = at_us(true, {5, 9}, 9);
  const LogicTrace rx = at_us(false, {5, 7}, 7);
  EXPECT_EQ(written({{"tx", &tx}, {"rx", &rx}}, Seconds(20e-6)),
            "$version cosys-sim $end\n$timescale 1 us $end\n$scope module cosys $end\n"
            "$var wire 1 ! tx $end\n$var wire 1 \" rx $end\n$upscope $end\n$enddefinitions $end\n"
            "#0\n$dumpvars\n1!\n0\"\n$end\n#5\n0!\n1\"\n#7\n0\"\n#9\n1!\n#20\n1!\n0\"\n");
}

TEST(Vcd, RoundsToTheMicrosecondAndDropsWhatIsShorter) {
  const LogicTrace line = at_us(true, {0.2, 3.4, 10.6, 10.9, 11.4, 20.1, 20.3, 31}, 31);
  const std::string text = written({{"rx", &line}}, Seconds(40e-6));
  EXPECT_EQ(text.substr(text.find("#0")),
            "#0\n$dumpvars\n0!\n$end\n#3\n1!\n#11\n0!\n#31\n1!\n#40\n1!\n");
}

TEST(Vcd, NothingIsWrittenFromTheEndOn) {
  const LogicTrace line = at_us(true, {5, 9, 12}, 12);
  const auto back = wires_in(written({{"rx", &line}}, Seconds(9e-6)));
  EXPECT_EQ(edges_to_ns(back.at(0).trace), (std::vector<double>{5}));
  EXPECT_DOUBLE_EQ(back.at(0).trace.end().value, 9e-6);
}

TEST(Vcd, ReadingUndoesWritingForAnyNumberOfWires) {
  Random random(21);
  for (const std::size_t count : {1U, 2U, 93U, 94U, 95U, 300U}) {
    std::vector<std::vector<double>> edges(count);
    std::vector<LogicTrace> traces;
    std::vector<VcdWire> wires;
    for (auto& times : edges) {
      double t = 0;
      for (auto n = random() % 40; n > 0; --n) times.push_back(t += 1 + double(random() % 1000));
      traces.push_back(at_us(random() % 2 == 0, times, 0));
    }
    for (auto& trace : traces) wires.push_back({"w" + std::to_string(wires.size()), &trace});
    const auto back = wires_in(written(wires, Seconds(0.05)));
    ASSERT_EQ(back.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(back[i].name, wires[i].name);
      EXPECT_EQ(back[i].trace.initial(), traces[i].initial());
      EXPECT_EQ(edges_to_ns(back[i].trace), edges[i]);
      EXPECT_DOUBLE_EQ(back[i].trace.end().value, 0.05);
    }
  }
}

// --- what is read

TEST(Vcd, ReadsAnyTimescale) {
  for (const auto& [timescale, tick_us] : std::map<std::string, double>{
           {"1us", 1}, {"1 us", 1}, {"10 ns", 0.01}, {"100\nns", 0.1}, {"2us", 2}, {"1 ms", 1e3}}) {
    const auto back = wires_in(file_of_one_wire("#0 1! #300 0! #700 1! #900", timescale));
    EXPECT_EQ(edges_to_ns(back.at(0).trace), (std::vector{300 * tick_us, 700 * tick_us}))
        << timescale;
    EXPECT_NEAR(back.at(0).trace.end().value, 900e-6 * tick_us, 1e-12);
  }
  EXPECT_DOUBLE_EQ(wires_in(file_of_one_wire("#5", "1s")).at(0).trace.end().value, 5);
  EXPECT_DOUBLE_EQ(wires_in(file_of_one_wire("#5000", "1 ps")).at(0).trace.end().value, 5e-9);
  EXPECT_DOUBLE_EQ(wires_in(file_of_one_wire("#5000", "100fs")).at(0).trace.end().value, 5e-10);
}

TEST(Vcd, SkipsWhatIsNoOneBitWire) {
  const auto back = wires_in(
      "$date today $end $comment #5 $var $end $timescale 1us $end $scope module top $end\n"
      "$var real 64 r volts $end $var reg 8 v bus [7:0] $end $var event 1 e tick $end\n"
      "$var logic 1 a data [3] $end $scope module dut $end $var wire 1 a inner $end $upscope $end\n"
      "$var integer 32 i n $end $upscope $end $enddefinitions $end\n"
      "$dumpvars r0.5 r b10101010 v 0a bx i $end\n"
      "#10 1a 1e r1e3 r $comment 0a #3 $end b1 v #20 b0 a #30 sIDLE v #40 B1 a #50\n");
  ASSERT_EQ(back.size(), 2U);
  EXPECT_EQ(back[0].name, "data[3]");
  EXPECT_EQ(back[1].name, "inner");
  EXPECT_TRUE(back[1].trace == back[0].trace);
  EXPECT_FALSE(back[0].trace.initial());
  EXPECT_EQ(edges_to_ns(back[0].trace), (std::vector<double>{10, 20, 40}));
}

TEST(Vcd, UnknownLevelsKeepTheLastAndAnUnknownStartIsIdle) {
  const auto edges = [](const std::string& body) {
    const auto trace = wires_in(file_of_one_wire(body)).at(0).trace;
    EXPECT_EQ(trace.initial(), body.find("#0 0!") != 0) << body;
    return edges_to_ns(trace);
  };
  using Times = std::vector<double>;
  EXPECT_EQ(edges("#0 x! #5 0! #9 1!"), (Times{5, 9}));
  EXPECT_EQ(edges("#0 #5 0! #9 1!"), (Times{5, 9}));
  EXPECT_EQ(edges("#0 0! #5 z! #9 1!"), (Times{9}));
  EXPECT_EQ(edges("#0 1! #5 X! #6 1! #7 Z! #9 0!"), (Times{9}));
  EXPECT_EQ(edges("#0"), Times{});
  EXPECT_EQ(edges(""), Times{});
}

// VHDL simulators (GHDL, nvc) write the nine values of IEEE 1164.
TEST(Vcd, TheNineValuesOfVhdlAreLevelsOrSayNothing) {
  for (const std::string nothing : {"U", "X", "Z", "W", "-", "u", "x", "z", "w"})
    for (const std::string low : {"0", "L", "l"})
      for (const std::string high : {"1", "H", "h"}) {
        const std::string body = "#0 " + nothing + "! " + high + "! #5 " + low + "! #6 " + nothing +
                                 "! #7 b" + nothing + " ! #9 b" + high + " !";
        const auto trace = wires_in(file_of_one_wire(body)).at(0).trace;
        EXPECT_TRUE(trace.initial()) << body;
        EXPECT_EQ(edges_to_ns(trace), (std::vector<double>{5, 9})) << body;
      }
}

TEST(Vcd, ADumpThatIsSwitchedOffSaysNothing) {
  EXPECT_EQ(edges_to_ns(wires_in(file_of_one_wire("#0 $dumpvars 1! $end #5 0! #6 $dumpoff x! $end "
                                                  "#8 $dumpon 0! $end #9 1! #10 $dumpall 1! $end"))
                            .at(0)
                            .trace),
            (std::vector<double>{5, 9}));
}

// Scopy and migen.
TEST(Vcd, ABlankMayPartAValueFromItsCode) {
  const auto both = wires_in(
      "$timescale 1 us $end $var wire 1 $ a $end $var wire 1 # b $end $enddefinitions $end\n"
      "#0 1 $ 0 # #5 0 $\n#7\n1\n#\n#9 1\t$ #12");
  EXPECT_EQ(edges_to_ns(both.at(0).trace), (std::vector<double>{5, 9}));
  EXPECT_EQ(edges_to_ns(both.at(1).trace), (std::vector<double>{7}));
}

TEST(Vcd, TimesMayHaveAFraction) {
  const auto trace =
      wires_in(file_of_one_wire("#0.000 1! #12.5 0! #31666.667 1! #40000.")).at(0).trace;
  EXPECT_EQ(edges_to_ns(trace), (std::vector<double>{12.5, 31666.667}));
  EXPECT_DOUBLE_EQ(trace.end().value, 0.04);
}

TEST(Vcd, AMissingTimescaleMayBeTold) {
  const std::string bare = "$var wire 1 ! rx $end $enddefinitions $end\n#0 1! #5 0! #7";
  EXPECT_EQ(edges_to_ns(wires_in(bare, with_tick(Seconds(1e-6))).at(0).trace),
            (std::vector<double>{5}));
  EXPECT_EQ(edges_to_ns(wires_in(bare, with_tick(Seconds(1e-3))).at(0).trace),
            (std::vector<double>{5e3}));
  EXPECT_EQ(
      edges_to_ns(wires_in(file_of_one_wire("#0 1! #5 0!"), with_tick(Seconds(1))).at(0).trace),
      (std::vector<double>{5e6}))
      << "what is told holds, as --sample-rate does";
}

TEST(Vcd, AnExtendedDumpIsRefusedByName) {
  const std::string why = " (an extended VCD says who drives a port) dump it with $dumpvars";
  EXPECT_EQ(vcd_failure(std::string("$timescale 1ns $end\n$var port 1 <0 rx $end\n")),
            "'$var port' in a.vcd:2" + why);
  EXPECT_EQ(vcd_failure(file_of_one_wire("#0\n$dumpports\npD 6 6 <0\n")),
            "$dumpports in a.vcd:3" + why);
}

TEST(Vcd, ALateFirstTimeGivesTheInitialLevel) {
  const auto trace = wires_in(file_of_one_wire("#1000 0! #1500 1!")).at(0).trace;
  EXPECT_FALSE(trace.initial());
  EXPECT_EQ(edges_to_ns(trace), (std::vector<double>{1500}));
}

TEST(Vcd, ErrorsNameFileLineAndReason) {
  const auto contains = [](const std::string& changes, const std::string& part) {
    const std::string text = changes + "\n";
    EXPECT_NE(vcd_failure(text).find(part), std::string::npos) << vcd_failure(text);
    EXPECT_EQ(vcd_failure(text).find('\n'), std::string::npos);
  };
  EXPECT_NE(vcd_failure(std::string())
                .find("the file ends early in a.vcd:1 ($enddefinitions is missing)"),
            std::string::npos);
  contains("$date\n\n$en", "a.vcd:4 ($end is missing)");
  contains("PK\x03\x04 zip", "'PK\\x03\\x04' in a.vcd:1 (not a VCD declaration)");
  contains("$enddefinitions $end",
           "no $timescale in a.vcd:1 (times have no unit without it) say --time-unit 1us");
  contains(file_of_one_wire("", "us"), "timescale 'us'");
  contains(file_of_one_wire("", "1 lightyear"), "timescale '1lightyear'");
  contains(file_of_one_wire("", "0 us"), "timescale '0us'");
  contains(file_of_one_wire("", "-1 us"), "timescale '-1us'");
  contains(file_of_one_wire("", "4294967297 us"), "timescale");
  contains(file_of_one_wire("\n#5 1!\n#abc"), "time '#abc' in a.vcd:4");
  contains(file_of_one_wire("#-5"), "time '#-5' in a.vcd:2");
  contains(file_of_one_wire("#"), "time '#' in a.vcd:2");
  contains(file_of_one_wire("#99999999999999999999999"), "more than 30 years");
  for (const char* time : {"#1e5", "#1.5x", "#.5", "#nan", "#0x9", "#1,5"})
    contains(file_of_one_wire(time),
             std::string("time '") + time + "' in a.vcd:2 (it must be # and a numb");
  contains(file_of_one_wire("#18446744073709551615"), "more than 30 years");
  contains(file_of_one_wire("#9 0!\n#5 1!"), "time #5 in a.vcd:3 (it is before");
  contains(file_of_one_wire("#5 1?"), "value of '?' in a.vcd:2 (no $var declares it)");
  contains(file_of_one_wire("#5 b2 !"), "'b2' in a.vcd:2 (not a VCD value change)");
  contains(file_of_one_wire("#5 b !"), "'b' in a.vcd:2 (not a VCD value change)");
  contains(file_of_one_wire("#5 q!"), "'q!' in a.vcd:2 (not a VCD value change)");
  contains(file_of_one_wire(std::string(10000, '1')), "a word of over 4096 characters in a.vcd:2");
  contains(file_of_one_wire("#5 $comment 1!"), "$end is missing");
  std::istringstream garbage("garbage");
  CaptureFacts facts;
  EXPECT_EQ(vcd_failure([&] { open_vcd(garbage, "a\nb.vcd", {}, facts); }),
            "'garbage' in a?b.vcd:1 (not a VCD declaration) give a complete text VCD file, as "
            "sigrok-cli -O vcd or PulseView write it");
}

// A simulator that was killed: what stands before the last word is read, and the last word only if
// it is whole beyond doubt.
TEST(Vcd, IsReadUpToWhereItIsCut) {
  const auto edges = [](const std::string& changes) {
    return edges_to_ns(wires_in(file_of_one_wire("#1 1!\n#5 0!\n#9 1!\n" + changes)).at(0).trace);
  };
  const std::vector<double> two{5, 9}, three{5, 9, 12};
  for (const char* cut :
       {"", "#", "#1", "#12", "#12 ", "#12 0", "#12 b", "#12 b0", "#12 0?", "$dump", "r1."})
    EXPECT_EQ(edges(cut), two) << cut;
  EXPECT_EQ(edges("#12 0!"), three);
  const std::string text =
      "$timescale 1 ns $end $var wire 1 ! a $end $var wire 1 !! b $end $enddefinitions $end\n"
      "#1 1! 1!! #5 0";
  EXPECT_TRUE(wires_in(text + "!").at(0).trace.edges().empty()) << "of which wire?";
  EXPECT_EQ(wires_in(text + "!\n").at(0).trace.edges().size(), 1U);
}

TEST(Vcd, TimescalesThatContradictAreRefused) {
  const std::string text =
      "$timescale 1 us $end $timescale 1 ns $end $var wire 1 ! a $end $enddefinitions $end\n#1 "
      "1!\n";
  EXPECT_TRUE(vcd_failure(text).starts_with(
      "timescale '1ns' in a.vcd:1 (another one stands before it) say --time-unit 1us"));
  EXPECT_EQ(wires_in(text, with_tick(Seconds(1e-9))).size(), 1U);
  EXPECT_EQ(wires_in(file_of_one_wire("#5 1!", "0 ps"), with_tick(Seconds(1e-9))).size(), 1U)
      << "Verilator's";
}

TEST(Vcd, VectorsMayBeWideAndAreSaid) {
  const std::string text =
      "$timescale 1 us $end $var reg 9000 % memory [8999:0] $end $var wire 16 & "
      "gpio[15:0] $end $var wire 1 ! rx $end $enddefinitions $end\n#1 b" +
      std::string(9000, '0') + " % 1! #5 0!\n";
  std::istringstream in(text);
  CaptureFacts facts;
  EXPECT_EQ(read_whole(*open_vcd(in, "a.vcd", {}, facts)).at(0).trace.edges().size(), 1U);
  EXPECT_EQ(facts.assumed, std::vector<std::string>{"no line in its vectors (2)"});
  for (const char* wire : {"gpio", "gpio[3]"}) {
    CaptureSettings settings;
    settings.wire = wire;
    std::istringstream again(text);
    EXPECT_EQ(vcd_failure([&] { open_vcd(again, "a.vcd", settings, facts); }),
              std::string("--wire ") + wire +
                  " is no wire in a.vcd:1 (it is a vector of 16 bits, and a line is one bit) dump "
                  "that bit as a wire");
  }
}

TEST(Vcd, AVectorElsewhereDoesNotHideTheWire) {
  const std::string text =
      "$timescale 1 us $end $scope module a $end $var reg 8 % rx[7:0] $end $upscope $end "
      "$scope module b $end $var wire 1 ! RX $end $upscope $end $enddefinitions $end\n#1 1! #5 "
      "0!\n";
  CaptureSettings settings;
  settings.wire = "rx";
  EXPECT_EQ(wires_in(text, settings).at(0).trace.edges().size(), 1U);
}

TEST(Vcd, GarbageIsReadOrRefusedButNeverCrashes) {
  Random random(22);
  const LogicTrace line = at_us(true, {5, 9, 1200, 1201}, 1201);
  const std::string good = written({{"tx", &line}, {"rx", &line}}, Seconds(0.01));
  const std::vector<std::string> words = {
      "$var",           "$end", "$timescale", "#",    "#7", "b",     "1!", "1\"", "wire",
      "$comment",       "1",    "\x01\xff",   "r1.5", "z!", "#9e99", "s",  "us",  "\n",
      "$enddefinitions"};
  int refused = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string text = good;
    for (auto n = 1 + random() % 4; n > 0; --n) {
      const std::size_t at = random() % (text.size() + 1);
      const auto kind = random() % 4;
      if (kind == 0) text.resize(at);
      if (kind == 1 && at < text.size()) text[at] = static_cast<char>(random());
      if (kind == 2) text.insert(at, ' ' + words[random() % words.size()] + ' ');
      if (kind == 3) text.erase(at, random() % 20);
    }
    try {
      for (const auto& wire : wires_in(text)) {
        protocol::receive_mid_bit(wire.trace, Hertz(600));
        protocol::receive_atmega(wire.trace, Hertz(600));
      }
    } catch (const Failure&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_LT(refused, 4000);
}

}  // namespace
}  // namespace sim
