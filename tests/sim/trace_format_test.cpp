// Traces as captures: what trace writes, decode's readers and the tools of others read.
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "capture_lines.hpp"
#include "program.hpp"
#include "sim/capture/capture_file.hpp"
#include "sim/capture/pulse_capture.hpp"
#include "sim/trace/pulse_write.hpp"
#include "sim/trace/session_write.hpp"
#include "sim/trace/vcd.hpp"

namespace {

using sim::test::edges_us;
using sim::test::Random;

const std::string on_the_wire = "IND 011111 OK 46\n";

bool is_there(const char* tool) {
  return std::system((std::string("command -v ") + tool + " >/dev/null").c_str()) == 0;
}

std::vector<long> less_the_first(std::vector<long> times) {
  for (std::size_t i = times.size(); i-- > 0;) times[i] -= times[0];
  return times;
}

TEST(Pulses, ReadingUndoesWriting) {
  Random random(61);
  for (int trial = 0; trial < 100; ++trial) {
    const dsp::LogicTrace wire = sim::test::random_trace(random, true, 2 * (random() % 30));
    std::stringstream text;
    sim::write_pulses(text, wire);
    const auto back = sim::read_whole(*sim::open_pulses(text, "t.ook")).at(0).trace;
    ASSERT_TRUE(back.initial());
    ASSERT_EQ(less_the_first(edges_us(back)), less_the_first(edges_us(wire)));
    if (wire.edges().empty()) continue;
    EXPECT_NEAR((back.end() - back.edges()[0]).value, (wire.end() - wire.edges()[0]).value, 1e-9);
  }
}

TEST(Pulses, HaveNothingOfWhatRoundingTakes) {
  dsp::LogicTrace wire(false);
  for (const double us : {10.0, 20.0, 20.3, 30.0, 30.2, 40.0, 50.0})
    wire.add_edge(dsp::Seconds(us * 1e-6));
  wire.observe_until(dsp::Seconds(60e-6));
  std::ostringstream text;
  sim::write_pulses(text, wire);
  EXPECT_EQ(text.str(),
            std::string(sim::pulses_head) + ";ook 2 pulses\n;freq1 0\n10 30\n10 10\n;end\n");
}

class Session : public CommandLine {
 protected:
  sim::Capture open(const std::string& bytes, const std::string& wire = "") const {
    std::ofstream(path("t.sr"), std::ios::binary) << bytes;
    return sim::open_capture(path("t.sr"), {wire, {}, ""});
  }

  static sim::TracedTrial random_trial(Random& random, std::size_t readings) {
    sim::TracedTrial trial;
    trial.tx = sim::test::random_trace(random, true, random() % 40);
    trial.rx = sim::test::random_trace(random, random() % 2 == 0, random() % 40);
    const auto end = std::max(
        {trial.tx.end(), trial.rx.end(), dsp::Seconds(1e-6 * static_cast<double>(readings))});
    trial.tx.observe_until(end);
    trial.sample_rate = dsp::Hertz(1e6);
    for (const sim::Tap& tap : sim::analogue_taps())
      for (std::size_t i = 0; i < readings; ++i)
        (trial.taps.*tap.samples).push_back(static_cast<float>(sim::test::uniform(random, -1, 1)));
    return trial;
  }
};

TEST_F(Session, ReadingUndoesWriting) {
  Random random(62);
  for (int trial = 0; trial < 20; ++trial) {
    const std::size_t readings = trial % 2 == 0 ? 0 : 50'000;
    const sim::TracedTrial traced = random_trial(random, readings);
    const std::string bytes = sim::trace_as_session(traced);
    EXPECT_EQ(bytes, sim::trace_as_session(traced));
    const auto wires = sim::read_whole(*open(bytes).logic);
    ASSERT_EQ(wires.size(), 2U);
    EXPECT_EQ(wires[0].name + wires[1].name, "txrx");
    EXPECT_EQ(wires[0].trace.initial(), traced.tx.initial());
    EXPECT_EQ(wires[1].trace.initial(), traced.rx.initial());
    EXPECT_EQ(edges_us(wires[0].trace), edges_us(traced.tx));
    EXPECT_EQ(edges_us(wires[1].trace), edges_us(traced.rx));
    for (const sim::Tap& tap : sim::analogue_taps()) {
      if (readings == 0) continue;
      const sim::Capture capture = open(bytes, tap.name);
      std::vector<std::complex<float>> samples(readings + 10);
      ASSERT_EQ(capture.samples->read(samples), readings + 1);
      const std::vector<float>& written = traced.taps.*tap.samples;
      EXPECT_EQ(samples[0].real(), written[0]);
      for (std::size_t i = 0; i < readings; ++i) ASSERT_EQ(samples[i + 1].real(), written[i]);
    }
  }
}

TEST_F(Session, CutOrBentIsRefusedOrRead) {
  Random random(63);
  const std::string good = sim::trace_as_session(random_trial(random, 0));
  std::size_t refused = 0;
  const auto is_refused = [&](const std::string& bytes) {
    return sim::test::failure_of([&] { sim::read_whole(*open(bytes).logic); }) != "no failure";
  };
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_TRUE(is_refused(good.substr(0, size))) << size;
  for (int round = 0; round < 500; ++round) {
    std::string bad = good;
    for (auto n = 1 + random() % 3; n > 0; --n)
      bad[random() % bad.size()] = static_cast<char>(random());
    refused += is_refused(bad);
  }
  EXPECT_GT(refused, 100U);
}

TEST_F(CommandLine, DecodeReadsEveryTraceAlike) {
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  for (const char* file : {"t.vcd", "t.sr", "t.ook", "t.csv", "t.bin"}) {
    ASSERT_EQ(program({"trace", "s.toml", "-o", file}).code, 0) << file;
    Words decode{"decode", file, "--wire", "rx"};
    if (std::string(file) == "t.bin") decode = {"decode", file, "--wire", "1", "--sample-rate=1e6"};
    const Outcome o = program(decode);
    EXPECT_NE(o.out.find(" s  ok              IND 011111 OK\n"), std::string::npos)
        << file << o.err;
    EXPECT_NE(o.out.find("\ncharacters              17\n"), std::string::npos) << file << o.out;
  }
}

TEST_F(CommandLine, DecodeReadsTheLightOfEveryTrace) {
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.sr", "--taps"}).code, 0);
  for (const char* file : {"t.wav", "t.sigmf-meta"})
    ASSERT_EQ(program({"trace", "s.toml", "-o", file}).code, 0) << file;
  for (const Words& decode :
       {Words{"decode", "t.sr", "--wire", "irradiance_mw_per_m2"}, Words{"decode", "t.wav"},
        Words{"decode", "t.sigmf-meta"}, Words{"decode", "t-baseband.sigmf-meta"}}) {
    const Outcome o = program(decode);
    EXPECT_NE(o.out.find(" s  ok              IND 011111 OK\n"), std::string::npos)
        << decode[1] << o.err;
    EXPECT_NE(o.out.find("\ncharacters              17\n"), std::string::npos)
        << decode[1] << o.out;
  }
}

TEST_F(CommandLine, SigrokReadsRawSamples) {
  if (!is_there("sigrok-cli")) GTEST_SKIP() << "sigrok-cli is not installed";
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.bin"}).code, 0);
  for (const char* wire : {"0", "1"})
    EXPECT_EQ(
        tool("sigrok-cli", {"-i", "t.bin", "-I", "binary:numchannels=2:samplerate=1000000", "-P",
                            std::string("uart:rx=") + wire + ":baudrate=600", "-B", "uart=rx"}),
        on_the_wire);
}

TEST_F(CommandLine, SigrokReadsWiresAndTapsOfASession) {
  if (!is_there("sigrok-cli")) GTEST_SKIP() << "sigrok-cli is not installed";
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.sr", "--taps"}).code, 0);
  for (const char* wire : {"rx", "tx"}) {
    const std::string uart = std::string("uart:rx=") + wire + ":baudrate=600";
    EXPECT_EQ(tool("sigrok-cli", {"-i", "t.sr", "-P", uart, "-B", "uart=rx"}), on_the_wire);
  }
  const std::string shown = tool("sigrok-cli", {"-i", "t.sr", "--show"});
  for (const char* fact : {"irradiance_mw_per_m2: analog", "agc_gain: analog", "rx: logic"})
    EXPECT_NE(shown.find(fact), std::string::npos) << fact << " in " << shown;
}

TEST_F(CommandLine, SigrokReadsASessionOfWiresAlone) {
  if (!is_there("sigrok-cli")) GTEST_SKIP() << "sigrok-cli is not installed";
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.sr", "--pin", "D2", "--tail", "1s"}).code, 0);
  for (const char* wire : {"D2", "tx"})
    EXPECT_EQ(tool("sigrok-cli", {"-i", "t.sr", "-P", std::string("uart:baudrate=600:rx=") + wire,
                                  "-B", "uart=rx"}),
              on_the_wire);
  const std::string shown = tool("sigrok-cli", {"-i", "t.sr", "--show"});
  EXPECT_EQ(shown.find("analog"), std::string::npos) << shown;
  const Outcome read = program({"decode", "t.sr"});
  EXPECT_EQ(read.code, 0) << read.err;
  EXPECT_TRUE(read.out.starts_with("read t.sr as sr: channel D2 ")) << read.out;
}

TEST_F(CommandLine, WiresGoOnBehindATrialForATail) {
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  const auto end_us = [&](const Words& more) {
    Words words{"trace", "s.toml", "-o", "t.vcd"};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(program(words).code, 0);
    const std::string vcd = content(path("t.vcd"));
    return std::stol(vcd.substr(vcd.rfind('#') + 1));
  };
  EXPECT_EQ(end_us({"--tail", "1.5s"}), end_us({}) + 1'500'000);
}

TEST_F(CommandLine, TraceRefusesWishesThatAFormatCannotFulfil) {
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  const auto refused = [&](const Words& more, const std::string& line) {
    Words words{"trace", "s.toml", "-o"};
    words.insert(words.end(), more.begin(), more.end());
    expect_refused(words, 2, line);
  };
  refused({"t.vcd", "--taps"}, "--taps (t.vcd has none) leave it out, or end the name in .sr");
  refused({"t.csv", "--taps"},
          "--taps (t.csv has them anyway) leave it out, or end the name in .sr");
  refused({"t.ook", "--pin", "D2"},
          "--pin D2 (a wire of t.ook gets no other name) leave it out, or end the name in .vcd or "
          ".sr");
  for (const char* file : {"t.h5", "t.svg"})
    refused({file, "--tail", "1s"},
            std::string("--tail (") + file +
                " shows the trial alone, as its samples end there) leave it out, or end the name "
                "in .vcd, .sr, .ook or .bin");
  refused({"t.sr", "--taps", "--tail", "1s"},
          "--tail (t.sr shows the trial alone, as its samples end there) leave out --tail or "
          "--taps");
  refused({"t.vcd", "--pin", "tx"},
          "--pin tx (another wire or tap is called so) choose another name");
  refused({"t.vcd", "--tail", "11min"},
          "--tail: 11min is no time such as 1s or 2min, from 0.1s to 600s (wrong usage) see "
          "cosys-sim trace --help");
  refused(
      {"t.vcd", "--pin", "D 2"},
      "--pin: D 2 is no name of a wire such as iogD_2 (wrong usage) see cosys-sim trace --help");
}

TEST_F(CommandLine, SigrokReadsTheColumnsOfWires) {
  if (!is_there("sigrok-cli")) GTEST_SKIP() << "sigrok-cli is not installed";
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.csv"}).code, 0);
  for (const char* wire : {"rx", "tx"})
    EXPECT_EQ(tool("sigrok-cli",
                   {"-i", "t.csv", "-I", "csv:column_formats=-,l,5-,l:header=yes:samplerate=250000",
                    "-P", std::string("uart:rx=") + wire + ":baudrate=600", "-B", "uart=rx"}),
              on_the_wire);
}

// Noise, of which a UART makes characters, framing errors and breaks.
TEST_F(Session, SigrokSaysTheSameOfItAsOfAVcd) {
  if (!is_there("sigrok-cli")) GTEST_SKIP() << "sigrok-cli is not installed";
  Random random(64);
  sim::TracedTrial trial;
  trial.rx = sim::test::random_trace(random, true, 2000);
  trial.tx.observe_until(trial.rx.end());
  std::ofstream(path("t.sr"), std::ios::binary) << sim::trace_as_session(trial);
  std::ofstream vcd(path("t.vcd"));
  sim::write_vcd(vcd, std::vector<sim::VcdWire>{{"rx", &trial.rx}}, trial.tx.end());
  vcd.close();
  const auto said = [&](const char* file) {
    return tool("sigrok-cli",
                {"-i", file, "-P", "uart:rx=rx:baudrate=2400", "-A",
                 "uart=rx-data:rx-warnings:rx-break", "--protocol-decoder-samplenum"});
  };
  const std::string of_session = said("t.sr");
  EXPECT_EQ(of_session, said("t.vcd"));
  EXPECT_NE(of_session.find("Frame error"), std::string::npos) << of_session;
}

TEST_F(CommandLine, Rtl433ReadsThePulses) {
  if (!is_there("rtl_433")) GTEST_SKIP() << "rtl_433 is not installed";
  write_scenario("s.toml", "receiver.range_m = [0.5]");
  ASSERT_EQ(program({"trace", "s.toml", "-o", "t.ook"}).code, 0);
  const std::string out =
      tool("rtl_433", {"-c", "/dev/null", "-R", "0", "-X",
                       "n=cosys,m=OOK_PCM,s=1667,l=1667,r=20000,invert,decode_uart", "-F", "json",
                       "-r", "t.ook"});
  std::string hex;
  for (const char byte : on_the_wire) {
    std::array<char, 3> digits{};
    std::snprintf(digits.data(), digits.size(), "%02x", static_cast<unsigned char>(byte));
    hex += digits.data();
  }
  EXPECT_NE(out.find("\"" + hex + "\""), std::string::npos) << out;
}

}  // namespace
