#include "sim/vcd.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <sstream>

#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/failure.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::LogicTrace;
using dsp::Seconds;
using protocol::Bytes;
using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11U) * 0x1p-53;
}

std::string written(const std::vector<VcdWire>& wires, Seconds duration) {
  std::ostringstream out;
  write_vcd(out, wires, duration);
  return out.str();
}

std::vector<VcdTrace> read(const std::string& text) {
  std::istringstream in(text);
  return read_vcd(in, "a.vcd");
}

/// A file with one wire `rx` of code `!` and this body.
std::string one_wire(const std::string& body, const std::string& timescale = "1 us") {
  return "$timescale " + timescale + " $end $var wire 1 ! rx $end $enddefinitions $end\n" + body;
}

std::vector<double> flips_us(const LogicTrace& trace) {
  std::vector<double> times;
  for (const Seconds flip : trace.flips()) times.push_back(std::round(flip.value * 1e9) / 1e3);
  return times;
}

LogicTrace at_us(bool initial, const std::vector<double>& flips, double end) {
  LogicTrace trace(initial);
  for (const double flip : flips) trace.flip_at(Seconds(flip * 1e-6));
  trace.observe_until(Seconds(end * 1e-6));
  return trace;
}

template <class Read>
std::string failure_of(const Read& read) {
  try {
    read();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::bad_input);
    return failure.what();
  }
  return "no failure";
}

std::string failure_of(const std::string& text) {
  return failure_of([&] { read(text); });
}

// --- what is written

TEST(Vcd, WritesInitialLevelsThenChangesThenABareLastTime) {
  const LogicTrace tx = at_us(true, {5, 9}, 9);
  const LogicTrace rx = at_us(false, {5, 7}, 7);
  EXPECT_EQ(written({{"tx", &tx}, {"rx", &rx}}, Seconds(20e-6)),
            "$version cosys-sim $end\n$timescale 1 us $end\n$scope module cosys $end\n"
            "$var wire 1 ! tx $end\n$var wire 1 \" rx $end\n$upscope $end\n$enddefinitions $end\n"
            "#0\n$dumpvars\n1!\n0\"\n$end\n#5\n0!\n1\"\n#7\n0\"\n#9\n1!\n#20\n");
}

TEST(Vcd, RoundsToTheMicrosecondAndDropsWhatIsShorter) {
  const LogicTrace line = at_us(true, {0.2, 3.4, 10.6, 10.9, 11.4, 20.1, 20.3, 31}, 31);
  const std::string text = written({{"rx", &line}}, Seconds(40e-6));
  EXPECT_EQ(text.substr(text.find("#0")),
            "#0\n$dumpvars\n0!\n$end\n#3\n1!\n#11\n0!\n#31\n1!\n#40\n");
}

TEST(Vcd, NothingIsWrittenFromTheEndOn) {
  const LogicTrace line = at_us(true, {5, 9, 12}, 12);
  const auto back = read(written({{"rx", &line}}, Seconds(9e-6)));
  EXPECT_EQ(flips_us(back.at(0).trace), (std::vector<double>{5}));
  EXPECT_DOUBLE_EQ(back.at(0).trace.end().value, 9e-6);
}

TEST(Vcd, ReadingUndoesWritingForAnyNumberOfWires) {
  Random random(21);
  for (const std::size_t count : {1U, 2U, 93U, 94U, 95U, 300U}) {
    std::vector<std::vector<double>> flips(count);
    std::vector<LogicTrace> traces;
    std::vector<VcdWire> wires;
    for (auto& times : flips) {
      double t = 0;
      for (auto n = random() % 40; n > 0; --n) times.push_back(t += 1 + double(random() % 1000));
      traces.push_back(at_us(random() % 2 == 0, times, 0));
    }
    for (auto& trace : traces) wires.push_back({"w" + std::to_string(wires.size()), &trace});
    const auto back = read(written(wires, Seconds(0.05)));
    ASSERT_EQ(back.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(back[i].name, wires[i].name);
      EXPECT_EQ(back[i].trace.initial(), traces[i].initial());
      EXPECT_EQ(flips_us(back[i].trace), flips[i]);
      EXPECT_DOUBLE_EQ(back[i].trace.end().value, 0.05);
    }
  }
}

// --- what is read

TEST(Vcd, ReadsAnyTimescale) {
  for (const auto& [timescale, tick_us] : std::map<std::string, double>{
           {"1us", 1}, {"1 us", 1}, {"10 ns", 0.01}, {"100\nns", 0.1}, {"2us", 2}, {"1 ms", 1e3}}) {
    const auto back = read(one_wire("#0 1! #300 0! #700 1! #900", timescale));
    EXPECT_EQ(flips_us(back.at(0).trace), (std::vector{300 * tick_us, 700 * tick_us})) << timescale;
    EXPECT_NEAR(back.at(0).trace.end().value, 900e-6 * tick_us, 1e-12);
  }
  EXPECT_DOUBLE_EQ(read(one_wire("#5", "1s")).at(0).trace.end().value, 5);
  EXPECT_DOUBLE_EQ(read(one_wire("#5000", "1 ps")).at(0).trace.end().value, 5e-9);
  EXPECT_DOUBLE_EQ(read(one_wire("#5000", "100fs")).at(0).trace.end().value, 5e-10);
}

TEST(Vcd, SkipsWhatIsNoOneBitWire) {
  const auto back = read(
      "$date today $end $comment #5 $var $end $timescale 1us $end $scope module top $end\n"
      "$var real 64 r volts $end $var reg 8 v bus [7:0] $end $var event 1 e tick $end\n"
      "$var logic 1 a data [3] $end $scope module dut $end $var wire 1 a inner $end $upscope $end\n"
      "$var integer 32 i n $end $upscope $end $enddefinitions $end\n"
      "$dumpvars r0.5 r b10101010 v 0a bx i $end\n"
      "#10 1a 1e r1e3 r $comment 0a #3 $end b1 v #20 b0 a #30 sIDLE v #40 B1 a #50\n");
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].name, "data[3]");
  EXPECT_FALSE(back[0].trace.initial());
  EXPECT_EQ(flips_us(back[0].trace), (std::vector<double>{10, 20, 40}));
}

TEST(Vcd, UnknownLevelsKeepTheLastAndAnUnknownStartIsIdle) {
  const auto flips = [](const std::string& body) {
    const auto trace = read(one_wire(body)).at(0).trace;
    EXPECT_EQ(trace.initial(), body.find("#0 0!") != 0) << body;
    return flips_us(trace);
  };
  using Times = std::vector<double>;
  EXPECT_EQ(flips("#0 x! #5 0! #9 1!"), (Times{5, 9}));
  EXPECT_EQ(flips("#0 #5 0! #9 1!"), (Times{5, 9}));
  EXPECT_EQ(flips("#0 0! #5 z! #9 1!"), (Times{9}));
  EXPECT_EQ(flips("#0 1! #5 X! #6 1! #7 Z! #9 0!"), (Times{9}));
  EXPECT_EQ(flips("#0"), Times{});
  EXPECT_EQ(flips(""), Times{});
}

TEST(Vcd, ALateFirstTimeGivesTheInitialLevel) {
  const auto trace = read(one_wire("#1000 0! #1500 1!")).at(0).trace;
  EXPECT_FALSE(trace.initial());
  EXPECT_EQ(flips_us(trace), (std::vector<double>{1500}));
}

TEST(Vcd, ErrorsNameFileLineAndReason) {
  const auto contains = [](const std::string& text, const std::string& part) {
    EXPECT_NE(failure_of(text).find(part), std::string::npos) << failure_of(text);
    EXPECT_EQ(failure_of(text).find('\n'), std::string::npos);
  };
  contains("", "the file ends early in a.vcd:1 ($enddefinitions is missing)");
  contains("$date\n\n$en", "a.vcd:3 ($end is missing)");
  contains("PK\x03\x04 zip",
           "'PK?"
           "?' in a.vcd:1 (not a VCD declaration)");
  contains("$enddefinitions $end", "no $timescale in a.vcd:1");
  contains(one_wire("", "us"), "timescale 'us'");
  contains(one_wire("", "1 lightyear"), "timescale '1lightyear'");
  contains(one_wire("", "0 us"), "timescale '0us'");
  contains(one_wire("", "-1 us"), "timescale '-1us'");
  contains(one_wire("", "4294967297 us"), "timescale");
  contains(one_wire("\n#5 1!\n#abc"), "time '#abc' in a.vcd:4");
  contains(one_wire("#-5"), "time '#-5' in a.vcd:2");
  contains(one_wire("#"), "time '#' in a.vcd:2");
  contains(one_wire("#99999999999999999999999"), "a whole number of ticks");
  contains(one_wire("#18446744073709551615"), "more than 30 years");
  contains(one_wire("#9 0!\n#5 1!"), "time #5 in a.vcd:3 (it is before");
  contains(one_wire("#5 1?"), "value of '?' in a.vcd:2 (no $var declares it)");
  contains(one_wire("#5 1"), "value of '' in a.vcd:2");
  contains(one_wire("#5 b1"), "a vector's code is missing");
  contains(one_wire("#5 q!"), "'q!' in a.vcd:2 (not a VCD value change)");
  contains(one_wire(std::string(10000, '1')), "a word of over 4096 characters in a.vcd:2");
  contains(one_wire("#5 $comment 1!"), "$end is missing");
  std::istringstream garbage("garbage");
  EXPECT_EQ(failure_of([&] { read_vcd(garbage, "a\nb.vcd"); }),
            "'garbage' in a?b.vcd:1 (not a VCD declaration) give a complete text VCD file, as "
            "sigrok-cli -O vcd or PulseView write it");
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
      for (const auto& wire : read(text)) {
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

// --- sigrok-cli as the judge. Its exit status is 0 even when it decodes nothing: outputs count.

/// A VCD file of its own for each process, gone at the end.
class TemporaryVcd {
 public:
  explicit TemporaryVcd(const LogicTrace& rx)
      : path_(std::filesystem::temp_directory_path() /
              ("cosys-vcd-test-" + std::to_string(getpid()) + ".vcd")) {
    std::ofstream out(path_);
    write_vcd(out, std::vector<VcdWire>{{"rx", &rx}}, rx.end());
  }
  ~TemporaryVcd() { std::filesystem::remove(path_); }
  TemporaryVcd(const TemporaryVcd&) = delete;
  TemporaryVcd& operator=(const TemporaryVcd&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string output;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get())) {
    output.push_back(static_cast<char>(c));
  }
  return output;
}

std::string sigrok(const LogicTrace& rx, int baud, const std::string& what) {
  const TemporaryVcd vcd(rx);
  return output_of("sigrok-cli -i '" + vcd.path().string() +
                   "' -P uart:rx=rx:format=hex:baudrate=" + std::to_string(baud) + ' ' + what);
}

Bytes sigrok_bytes(const LogicTrace& rx, int baud) {
  const std::string output = sigrok(rx, baud, "-B uart=rx");
  return {output.begin(), output.end()};
}

/// What a receiver says, in the order of time; in samples of 1 us from the start of the capture.
struct Event {
  double at;
  int value;  // of a byte, or -1: a frame error

  static constexpr int frame_error = -1;
};

std::ostream& operator<<(std::ostream& out, const Event& event) {
  return out << event.value << '@' << event.at;
}

/// sigrok's annotations: a byte from the edge of its first data bit, a frame error from half a bit
/// before the sample that showed it.
std::vector<Event> sigrok_events(const LogicTrace& rx, int baud) {
  std::istringstream lines(
      sigrok(rx, baud, "-A uart=rx-data:rx-warnings --protocol-decoder-samplenum"));
  std::vector<Event> events;
  for (std::string line; std::getline(lines, line);) {
    double at = 0;
    unsigned value = 0;
    const bool byte = line.find("Frame error") == std::string::npos;
    EXPECT_GE(std::sscanf(line.c_str(), "%lf-%*d uart-1: %2x", &at, &value), byte ? 2 : 1) << line;
    events.push_back({at, byte ? static_cast<int>(value) : Event::frame_error});
  }
  return events;
}

/// The same of our receiver.
std::vector<Event> our_events(const LogicTrace& rx, int baud) {
  const double bit_us = 1e6 / baud;
  std::vector<Seconds> false_starts;
  std::vector<Event> events;
  for (const auto& byte : protocol::receive_mid_bit(rx, Hertz(baud), &false_starts)) {
    const double start = byte.start.value * 1e6;
    events.push_back({start + bit_us, byte.value});
    if (byte.framing_error) events.push_back({start + 9 * bit_us, Event::frame_error});
  }
  for (const Seconds start : false_starts)
    events.push_back({start.value * 1e6, Event::frame_error});
  std::ranges::sort(events, {}, &Event::at);
  return events;
}

LogicTrace line_of(const Bytes& bytes, double baud) {
  LogicTrace line;
  Seconds t(0.005);
  for (const auto byte : bytes) t = protocol::send_byte(line, byte, t, Hertz(baud));
  line.observe_until(t + Seconds(12 / baud));
  return line;
}

TEST(VcdSigrok, DecodesWhatWeWriteToTheBytesSent) {
  const Bytes message = protocol::cosys_encode("IND 011111 OK");
  EXPECT_EQ(sigrok_bytes(line_of(message, 600), 600), message);
  Bytes all;
  for (int byte = 0; byte < 256; ++byte) all.push_back(static_cast<std::uint8_t>(byte));
  EXPECT_EQ(sigrok_bytes(line_of(all, 600), 600), all);
  EXPECT_EQ(sigrok_bytes(line_of(all, 1000), 1000), all);
}

TEST(VcdSigrok, MidBitToleratesExactlyTheRatesThatSigrokDoes) {
  const Bytes message = protocol::cosys_encode("IND 011111 OK");
  for (const double ratio : {0.93, 0.94, 0.945, 0.951, 1.0, 1.049, 1.055, 1.07}) {
    const auto ours = protocol::receive_mid_bit(line_of(message, 600 * ratio), Hertz(600));
    Bytes values;
    for (const auto& byte : ours) values.push_back(byte.value);
    EXPECT_EQ(values, sigrok_bytes(line_of(message, 600 * ratio), 600)) << ratio;
  }
}

/// Characters with random gaps, moved edges, dips, spikes and breaks. Every flip is on a grid of
/// 11 us from the first on: at 300, 600 and 1200 baud no instant at which a receiver samples, whole
/// microsecond (sigrok) or not (ours), is a flip or has one between the two.
LogicTrace damaged_line(Random& random, double baud) {
  constexpr double grid_us = 11;
  const double bit_us = 1e6 / baud;
  const auto bits = [&](double low, double high) { return uniform(random, low, high) * bit_us; };
  LogicTrace sent;
  Seconds t(0.005);
  for (int i = 0; i < 150; ++i) {
    t = protocol::send_byte(sent, static_cast<std::uint8_t>(random() >> 56U), t, Hertz(baud));
    if (random() % 3 == 0) t += Seconds(bits(0, 4) * 1e-6);
  }
  std::vector<double> flips;
  for (const Seconds flip : sent.flips()) flips.push_back(flip.value * 1e6 + bits(-0.3, 0.3));
  for (int i = 0; i < 60; ++i) {  // a pair of flips inverts what lies between
    const double at = uniform(random, 5000, flips.back());
    const double length = random() % 8 == 0 ? bits(5, 25) : bits(0, 1);
    flips.insert(flips.end(), {at, at + length});
  }
  std::ranges::sort(flips);
  LogicTrace line;
  for (const double flip : flips)
    line.flip_at(Seconds(std::round(flip / grid_us) * grid_us * 1e-6));
  line.set_at(line.end() + Seconds(grid_us * 1e-6), true);
  line.observe_until(line.end() + Seconds(20 * bit_us * 1e-6));
  return line;
}

TEST(VcdSigrok, MidBitEqualsSigrokByteForByteAndFrameErrorForFrameErrorOnDamagedLines) {
  Random random(23);
  std::size_t errors = 0;
  std::size_t false_starts = 0;
  for (const int baud : {300, 600, 1200}) {
    for (const double ratio : {0.94, 1.0, 1.05}) {
      const LogicTrace line = damaged_line(random, baud * ratio);
      const auto ours = our_events(line, baud);
      const auto theirs = sigrok_events(line, baud);
      ASSERT_EQ(ours.size(), theirs.size()) << baud << ' ' << ratio;
      for (std::size_t i = 0; i < ours.size(); ++i) {
        EXPECT_EQ(ours[i].value, theirs[i].value) << ours[i] << ' ' << theirs[i];
        EXPECT_NEAR(ours[i].at, theirs[i].at, 2) << "in " << i << " of baud " << baud;
        errors += ours[i].value == Event::frame_error ? 1 : 0;
      }
      std::vector<Seconds> starts;
      protocol::receive_mid_bit(line, Hertz(baud), &starts);
      false_starts += starts.size();
    }
  }
  EXPECT_GT(false_starts, 20U);  // both kinds of error were there to agree on
  EXPECT_GT(errors, false_starts + 50);
}

}  // namespace
}  // namespace sim
