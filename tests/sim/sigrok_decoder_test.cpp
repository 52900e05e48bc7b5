// The sigrok decoder of COSYS messages (protocol/sigrok), run by the real sigrok-cli, against
// `cosys-sim decode`: the same lines at the same times, with the same reasons.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "program.hpp"
#include "protocol/uart.hpp"
#include "sim/capture/capture_file.hpp"
#include "sim/trace/vcd.hpp"

namespace {

/// A line of either decoder; without a start where it has not ended.
struct Decoded {
  std::string outcome, message;
  std::optional<double> start_us;
};

class SigrokDecoder : public CommandLine {
 protected:
  SigrokDecoder() {
    ::setenv("SIGROKDECODE_DIR", COSYS_SOURCE_DIR "/protocol/sigrok", 1);
    ::setenv("PYTHONDONTWRITEBYTECODE", "1", 1);
  }
  void SetUp() override {
    if (start_tool("sigrok-cli", {"--version"}).finish().code != 0)
      GTEST_SKIP() << "needs sigrok-cli";
  }

  std::string sigrok(const Words& output, const std::string& decoder = "cosys") const {
    Words all{"-i", "t.vcd", "-P", "uart:rx=rx:baudrate=600," + decoder};
    all.insert(all.end(), output.begin(), output.end());
    return tool("sigrok-cli", all);
  }

  /// Lines that had not ended at a silence but did later are left out.
  std::vector<Decoded> by_sigrok(const std::string& decoder = "cosys") const {
    std::istringstream lines(sigrok({"-A", annotations, "--protocol-decoder-samplenum"}, decoder));
    std::vector<Decoded> all;
    for (std::string line; std::getline(lines, line);) {
      const std::size_t outcome = line.find("cosys-1: ") + 9, end = line.find(": ", outcome);
      if (!all.empty() && !all.back().start_us) all.pop_back();
      all.push_back({line.substr(outcome, end - outcome), line.substr(end + 2), {}});
      if (all.back().outcome != "no newline") all.back().start_us = std::stod(line);
    }
    return all;
  }

  std::vector<Decoded> by_cosys_sim() const {
    const Outcome o = program({"decode", "t.vcd", "--baud", "600", "--uart", "mid-bit", "--json"});
    EXPECT_EQ(o.code, 0) << o.err;
    std::istringstream lines(o.out);
    std::vector<Decoded> all;
    for (std::string line; std::getline(lines, line);) {
      const auto json = nlohmann::json::parse(line);
      if (json.contains("line")) break;  // what is said of all of it
      all.push_back({json.at("outcome"), json.at("message"), {}});
      if (json.contains("time_s")) all.back().start_us = json["time_s"].get<double>() * 1e6;
    }
    return all;
  }

  /// What both say; fails where they differ.
  std::vector<Decoded> by_both() const {
    const auto theirs = by_sigrok(), ours = by_cosys_sim();
    EXPECT_EQ(theirs.size(), ours.size());
    for (std::size_t i = 0; i < std::min(theirs.size(), ours.size()); ++i) {
      EXPECT_EQ(theirs[i].outcome, ours[i].outcome) << i;
      EXPECT_EQ(theirs[i].message, ours[i].message) << i;
      EXPECT_NEAR(theirs[i].start_us.value_or(0), ours[i].start_us.value_or(0), 2) << i;
    }
    return ours;
  }

  /// `flash_behind`: a byte behind which light flashes for less than half a bit.
  void write_line(const std::string& bytes, char flash_behind = 0) const {
    dsp::LogicTrace line;
    dsp::Seconds t(0.01);
    for (const char byte : bytes) {
      t = protocol::send_byte(line, static_cast<std::uint8_t>(byte), t, dsp::Hertz(600));
      if (byte != flash_behind) continue;
      line.add_edge(t + dsp::Seconds(1e-3));
      line.add_edge(t + dsp::Seconds(1.5e-3));
      t += dsp::Seconds(5e-3);
    }
    line.observe_until(t + dsp::Seconds(0.02));
    std::ofstream out(path("t.vcd"));
    sim::write_vcd(out, std::vector<sim::VcdWire>{{"rx", &line}}, line.end());
  }

  const std::string annotations =
      "cosys=ok:unprintable:too_short:not_hex:wrong_checksum:overlong:no_newline";
};

std::set<std::string> outcomes_of(const std::vector<Decoded>& lines) {
  std::set<std::string> outcomes;
  for (const Decoded& line : lines) outcomes.insert(line.outcome);
  return outcomes;
}

TEST_F(SigrokDecoder, HasEveryReasonOfDecode) {
  write_line("IND 011111 OK 46\n" + std::string(" 00\n") + "IND 011111 OK 4A\nx y 4\n\n 4g\n" +
             "IND 0\\1111 OK 2b\nIND\t 46\nRFID S:U 05\nRFID S:U 0a\n +5\n" +
             std::string(300, 'x') + "\nA 41\n" + std::string(255, 'y') +
             "\nB 42\n~\x7e\n\x7f\x7f\nend");
  const auto lines = by_both();
  EXPECT_EQ(outcomes_of(lines),
            (std::set<std::string>{"ok", "unprintable", "too_short", "not_hex", "wrong_checksum",
                                   "overlong", "no newline"}));
  EXPECT_EQ(lines.size(), 18U);
  EXPECT_EQ(sigrok({"-B", "cosys=messages"}), "IND 011111 OK\n\nIND 0\\1111 OK\nRFID S:U\nA\nB\n");
}

TEST_F(SigrokDecoder, TakesNoFlashForAByte) {
  write_line("IND 011111 OK 46\nIND 011111 OK 46\n", '1');
  const auto lines = by_both();
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[1].outcome, "ok");
}

TEST_F(SigrokDecoder, LimitsLinesAsItIsTold) {
  write_line("IND 011111 OK 46\nA 41\n");
  const auto lines = by_sigrok("cosys:max_line=8");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].outcome, "overlong");
  EXPECT_EQ(lines[0].message, "IND 0111");
  EXPECT_EQ(lines[1].outcome, "ok");
}

// Noise at the decisions damages any bit, start and stop bits too.
TEST_F(SigrokDecoder, AgreesOnTracesInNoise) {
  write("s.toml",
        "[receiver]\nmodule = 'ideal-coherent'\n"
        "[simulation]\nfidelity = 'decision'\nsample_rate_hz = 300000\nwarmup_messages = 15\n");
  std::set<std::string> outcomes;
  std::size_t framing_errors = 0;
  for (const char* ebn0_db : {"4", "7", "8", "10"}) {
    ASSERT_EQ(program({"trace", "s.toml", "--set", std::string("receiver.ebn0_db=") + ebn0_db, "-o",
                       "t.vcd"})
                  .code,
              0);
    outcomes.merge(outcomes_of(by_both()));
    const auto wires = sim::read_whole(*sim::open_capture(path("t.vcd"), {}).logic);
    const auto rx = std::ranges::find(wires, "rx", &sim::NamedTrace::name);
    std::string expected;
    for (const auto& byte : protocol::receive_mid_bit(rx->trace, dsp::Hertz(600)))
      if (byte.framing_error)
        expected += fmt::format("cosys-1: framing error: {:02x}\n", byte.value);
    EXPECT_EQ(sigrok({"-A", "cosys=framing_error"}), expected);
    framing_errors += expected.size();
  }
  EXPECT_GE(outcomes.size(), 5U);
  EXPECT_GT(framing_errors, 0U);
}

// A module whose gain control drowns the end of each message.
TEST_F(SigrokDecoder, AgreesOnTracesOfAModule) {
  write("s.toml", "[device]\ninterval_min_ms = 300\n[simulation]\nwarmup_messages = 2\n");
  std::set<std::string> outcomes;
  for (const char* range : {"1", "2.2", "3", "5"}) {
    ASSERT_EQ(program({"trace", "s.toml", "--set", std::string("receiver.range_m=") + range, "-o",
                       "t.vcd"})
                  .code,
              0);
    outcomes.merge(outcomes_of(by_both()));
  }
  EXPECT_TRUE(outcomes.contains("ok"));
  EXPECT_TRUE(outcomes.contains("no newline"));
}

}  // namespace
