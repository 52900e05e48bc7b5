// Our wires as sigrok reads them, and its UART decoder against our mid-bit receiver. The exit
// status of sigrok-cli is 0 even when it decodes nothing: outputs count.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>

#include "capture_lines.hpp"
#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/trace/vcd.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::LogicTrace;
using dsp::Seconds;
using protocol::Bytes;
using test::Random;
using test::uniform;

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

/// Characters with random gaps, moved edges, dips, spikes and breaks. Every edge is on a grid of
/// 11 us from the first on: at 300, 600 and 1200 baud no instant at which a receiver samples, whole
/// microsecond (sigrok) or not (ours), is an edge or has one between the two.
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
  std::vector<double> edges;
  for (const Seconds edge : sent.edges()) edges.push_back(edge.value * 1e6 + bits(-0.3, 0.3));
  for (int i = 0; i < 60; ++i) {  // a pair of edges inverts what lies between
    const double at = uniform(random, 5000, edges.back());
    const double length = random() % 8 == 0 ? bits(5, 25) : bits(0, 1);
    edges.insert(edges.end(), {at, at + length});
  }
  std::ranges::sort(edges);
  LogicTrace line;
  for (const double edge : edges)
    line.add_edge(Seconds(std::round(edge / grid_us) * grid_us * 1e-6));
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
