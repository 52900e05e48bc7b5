// Wires of LEDs: bursts of a carrier, sampled fast and slowly, are the line that they send.
#include "sim/capture/carrier_demodulator.hpp"

#include <gtest/gtest.h>

#include "capture_lines.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::LogicTrace;
using dsp::Seconds;
using test::Random;
using test::uniform;

class Recorded : public EdgeSource {
 public:
  explicit Recorded(LogicTrace trace) : trace_(std::move(trace)) {}
  bool initial() const override { return trace_.initial(); }
  std::optional<Seconds> next() override {
    if (next_ == trace_.edges().size()) return std::nullopt;
    return trace_.edges()[next_++];
  }
  Seconds known_until() const override { return next_ == 0 ? Seconds(0) : trace_.end(); }

 private:
  LogicTrace trace_;
  std::size_t next_ = 0;
};

/// A free-running carrier while the line is 0, as a logic analyser samples it.
LogicTrace keyed(const LogicTrace& line, double carrier, double rate, bool idle) {
  LogicTrace wire(idle);
  dsp::TraceReader reader(line);
  for (double i = 0; i / rate < line.end().value; ++i) {
    const double turns = i / rate * carrier;
    const bool on = !reader.level_at(Seconds(i / rate)) && turns - std::floor(turns) < 0.5;
    wire.set_at(Seconds(i / rate), on != idle);
  }
  wire.observe_until(line.end());
  return wire;
}

LogicTrace line_of(CarrierDemodulator& wire) {
  LogicTrace line(wire.initial());
  while (const auto edge = wire.next()) {
    EXPECT_LE(wire.known_until(), Seconds(1e3));
    line.add_edge(*edge);
    EXPECT_GE(wire.known_until(), *edge);
  }
  line.observe_until(wire.known_until());
  return line;
}

TEST(CarrierDemodulator, BurstsAreLight) {
  Random random(81);
  for (int trial = 0; trial < 12; ++trial) {
    const double carrier = uniform(random, 30e3, 70e3), rate = trial % 2 == 0 ? 500e3 : 8e6;
    const LogicTrace sent = test::bent_line(random, 2, 600, {});
    Recorded recorded(keyed(sent, carrier, rate, trial % 3 == 0));
    CarrierDemodulator wire(recorded, {});
    EXPECT_NEAR(wire.carrier() / Hertz(carrier), 1, 0.01) << trial;
    const LogicTrace line = line_of(wire);
    EXPECT_TRUE(line.initial());
    ASSERT_EQ(line.edges().size(), sent.edges().size()) << trial;
    for (std::size_t i = 0; i < line.edges().size(); ++i)
      EXPECT_NEAR(line.edges()[i].value, sent.edges()[i].value, 1 / carrier + 1 / rate);
    EXPECT_EQ(line.end(), sent.end());
  }
}

TEST(CarrierDemodulator, AToldCarrierIsTaken) {
  Random random(82);
  const LogicTrace sent = test::bent_line(random, 1, 600, {});
  Recorded slow(keyed(sent, 10e3, 1e6, false)), same(keyed(sent, 59e3, 1e6, false));
  CarrierDemodulator told(slow, Hertz(10e3)), without(same, Hertz(0));
  EXPECT_EQ(line_of(told).edges().size(), sent.edges().size());
  EXPECT_GT(line_of(without).edges().size(), 50 * sent.edges().size());
}

// A clock for a moment, as at a start, and then a line: its edges are far from each other.
TEST(CarrierDemodulator, ABurstBeforeALineIsNoCarrier) {
  LogicTrace wire;
  Seconds at(0.01);
  for (int i = 0; i < 2000; ++i, at = at + Seconds(5e-6)) wire.add_edge(at);
  at = at + Seconds(0.1);
  for (const std::uint8_t byte : protocol::cosys_encode("IND 011111 OK"))
    at = protocol::send_byte(wire, byte, at, Hertz(600));
  Recorded recorded(wire);
  EXPECT_EQ(CarrierDemodulator(recorded, std::nullopt).carrier(), Hertz(0));
}

TEST(CarrierDemodulator, AnyOtherWireIsPassedOn) {
  Random random(83);
  for (const double baud : {600.0, 9600.0, 115200.0}) {
    LogicTrace sent = test::bent_line(random, 6, baud, {});
    Recorded recorded(sent);
    CarrierDemodulator wire(recorded, {});
    EXPECT_EQ(wire.carrier(), Hertz(0)) << baud;
    EXPECT_TRUE(line_of(wire) == sent) << baud;
  }
  for (const bool initial : {false, true}) {
    Recorded none(LogicTrace(initial, Seconds(1)));
    CarrierDemodulator wire(none, {});
    EXPECT_TRUE(line_of(wire).edges().empty());
    EXPECT_EQ(wire.initial(), initial);
  }
}

}  // namespace
}  // namespace sim
