// Captures as sigrok-cli writes them, in all its layouts that decode reads: the message is that
// which sigrok's own UART decoder finds. COSYS_SIGROK_CAPTURES tries more than the usual captures.
#include <fmt/format.h>

#include <cstdlib>
#include <random>

#include "decoded_line.hpp"
#include "program.hpp"
#include "protocol/cosys.hpp"
#include "sanitized.hpp"

namespace {

constexpr const char* layouts[] = {"srzip",
                                   "vcd",
                                   "csv",
                                   "csv:time=true",
                                   "csv:time=true:dedup=true",
                                   "csv:time=true:label=off",
                                   "csv:time=true:dedup=true:label=off"};
constexpr double begin_s = 0.03, baud = 600;

/// A message on one of some wires, of which the others do not move.
struct Sampled {
  std::string message;
  int rate = 0, wires = 1, wire = 0;
  bool inverted = false;

  /// A byte a sample, as `sigrok-cli -I binary` takes it.
  std::string bytes() const {
    const protocol::Bytes sent = protocol::cosys_encode(message);
    const double lasts = 2 * begin_s + 10 * static_cast<double>(sent.size()) / baud;
    std::string bytes;
    for (int i = 0; i < lasts * rate; ++i) {
      const double slot = (static_cast<double>(i) / rate - begin_s) * baud;
      const auto byte = slot < 0 ? sent.size() : static_cast<std::size_t>(slot / 10);
      const bool level =
          byte >= sent.size() || protocol::line_bit(sent[byte], static_cast<int>(slot) % 10);
      bytes += static_cast<char>((level != inverted ? 1 : 0) << wire);
    }
    return bytes;
  }
};

class SigrokLayouts : public CommandLine {
 protected:
  Sampled drawn() {
    constexpr int usual[] = {20'000, 24'000, 48'000, 96'000, 100'000, 250'000, 600'000, 1'000'000};
    Sampled sampled;
    sampled.message = "IND ";
    for (int i = 0; i < 6; ++i) sampled.message += random_() % 2 == 0 ? '0' : '1';
    sampled.message += " OK";
    sampled.rate = random_() % 2 == 0 ? usual[random_() % std::size(usual)]
                                      : 12'000 + static_cast<int>(random_() % 100'000);
    sampled.wires = 1 + static_cast<int>(random_() % 8);
    sampled.wire = static_cast<int>(random_() % static_cast<std::uint64_t>(sampled.wires));
    sampled.inverted = random_() % 4 == 0;
    return sampled;
  }

  std::string sigrok(const Words& words) const {
    return start_tool("sigrok-cli", words).finish().out;
  }

  void make_session(const Sampled& sampled) const {
    write("in.bin", sampled.bytes());
    sigrok({"-i", "in.bin", "-I",
            fmt::format("binary:numchannels={}:samplerate={}", sampled.wires, sampled.rate), "-o",
            "in.sr"});
  }

  std::string its_bytes(const Sampled& sampled) const {
    return sigrok({"-i", "in.sr", "-P",
                   fmt::format("uart:rx={}:baudrate=600:invert_rx={}", sampled.wire,
                               sampled.inverted ? "yes" : "no"),
                   "-B", "uart=rx"});
  }

  void expect_read(const Sampled& sampled, const std::string& layout) const {
    const std::string file = "t." + (layout == "srzip" ? "sr" : layout.substr(0, layout.find(':')));
    sigrok({"-i", "in.sr", "-O", layout, "-o", file});
    const Outcome o = program({"decode", file, "--json"});
    const auto what =
        fmt::format("{} at {} Hz, wire {} of {}{}: {}{}", layout, sampled.rate, sampled.wire,
                    sampled.wires, sampled.inverted ? ", inverted" : "", o.out, o.err);
    ASSERT_EQ(o.code, 0) << what;
    EXPECT_NE(o.out.find("\"" + sampled.message + "\",\"outcome\":\"ok\""), std::string::npos)
        << what;
    const auto line = line_facts(o.out);
    EXPECT_EQ(line.at("baud"), baud) << what;
    EXPECT_EQ(line.at("polarity"), sampled.inverted ? "idle-low" : "idle-high") << what;
    std::filesystem::remove(path(file));
  }

  std::mt19937_64 random_{47};
};

int wanted_captures() {
  if (const char* told = std::getenv("COSYS_SIGROK_CAPTURES")) return std::atoi(told);
  return sim::test::is_set("COSYS_WEEKLY") ? 30 : 10;
}

TEST_F(SigrokLayouts, MeasuredAgainstItsUartDecoder) {
  for (int i = 0; i < wanted_captures() && !HasFailure(); ++i) {
    const Sampled sampled = drawn();
    make_session(sampled);
    const protocol::Bytes sent = protocol::cosys_encode(sampled.message);
    ASSERT_EQ(its_bytes(sampled), std::string(sent.begin(), sent.end()));
    for (const char* layout : layouts) expect_read(sampled, layout);
    std::filesystem::remove(path("in.sr"));
  }
}

}  // namespace
