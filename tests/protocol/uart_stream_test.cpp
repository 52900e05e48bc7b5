#include "protocol/uart_stream.hpp"

#include <gtest/gtest.h>

#include "lines.hpp"
#include "protocol/uart_receivers.hpp"

namespace protocol {
namespace {

using test::baud;
using test::Random;
using test::uniform;

/// Messages with pauses, and pulses of noise between and in them.
dsp::LogicTrace random_wire(Random& random) {
  dsp::LogicTrace line;
  dsp::Seconds at(0.002);
  for (int message = 0; message < 6; ++message) {
    for (const std::uint8_t byte : test::random_bytes(random, 1 + random() % 12))
      at = send_byte(line, byte, at + uniform(random, 0, 0.5) * dsp::period(baud), baud);
    at += dsp::Seconds(uniform(random, 0, 0.12));
    if (random() % 2 == 0) {  // a pulse of noise
      line.add_edge(at);
      at += dsp::Seconds(uniform(random, 1e-5, 3e-3));
      line.add_edge(at);
      at += dsp::Seconds(uniform(random, 0, 0.01));
    }
  }
  line.observe_until(at + dsp::Seconds(0.05));
  return line;
}

/// A wire that is never idle: characters, some of them with a wrong stop bit, breaks, which are low
/// for longer than a character, and noise too short to start one.
dsp::LogicTrace busy_wire(Random& random) {
  const dsp::Seconds bit = dsp::period(baud);
  dsp::LogicTrace line;
  dsp::Seconds at(0.002);
  for (int i = 0; i < 60; ++i) {
    const auto kind = random() % 8;
    const dsp::Seconds pulse = kind == 0   ? uniform(random, 10, 25) * bit  // a break
                               : kind == 1 ? uniform(random, 9.2, 9.9) * bit
                                           : uniform(random, 0.01, 0.6) * bit;
    if (kind > 4) {
      at = send_byte(line, test::random_bytes(random, 1)[0], at, baud);
    } else {
      line.set_at(at, false);
      at += pulse;
      line.set_at(at, true);
    }
    at += (random() % 2 == 0 ? 0 : uniform(random, 0, 1)) * bit;
  }
  line.observe_until(at + dsp::Seconds(0.05));
  return line;
}

/// The wire as it is known at `t`.
dsp::LogicTrace until(const dsp::LogicTrace& wire, dsp::Seconds t) {
  dsp::LogicTrace part(wire.initial());
  for (const dsp::Seconds edge : wire.edges())
    if (edge <= t) part.add_edge(edge);
  part.observe_until(t);
  return part;
}

/// All that a stream gives of a wire that is read at random times, 0 to `longest_step` apart.
std::vector<UartByte> read_often(const UartReceiver& receiver, const dsp::LogicTrace& wire,
                                 double phase, double longest_step, Random& random) {
  UartStream stream(receiver, baud, phase);
  std::vector<UartByte> bytes;
  for (dsp::Seconds t(0); t < wire.end(); t += dsp::Seconds(uniform(random, 0, longest_step)))
    for (const UartByte& byte : stream.take(until(wire, t))) bytes.push_back(byte);
  for (const UartByte& byte : stream.take(wire)) bytes.push_back(byte);
  EXPECT_TRUE(stream.take(wire).empty());
  return bytes;
}

TEST(UartStream, GivesTheBytesOfTheWholeWireWheneverItIsRead) {
  Random random(11);
  std::size_t framing_errors = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const dsp::LogicTrace wire = trial % 4 < 2 ? random_wire(random) : busy_wire(random);
    for (const UartReceiver& receiver : uart_receivers()) {
      const double phase = uniform(random, 0, 1);
      const auto whole = receiver.receive(wire, baud, phase);
      framing_errors += test::framing_errors(whole);
      ASSERT_EQ(read_often(receiver, wire, phase, trial % 2 == 0 ? 0.02 : 0.5, random), whole)
          << receiver.name << " " << trial;
    }
  }
  EXPECT_GT(framing_errors, 1000U);
}

/// Pulses and pauses of about one sample of the ATmega's, many of them between two samples.
dsp::LogicTrace glitchy_wire(Random& random) {
  dsp::LogicTrace line;
  dsp::Seconds at(0.002);
  for (int i = 0; i < 600; ++i) {
    line.add_edge(at);
    at += uniform(random, 0.005, 0.12) * dsp::period(baud);
  }
  line.observe_until(at + dsp::Seconds(0.05));
  return line;
}

TEST(UartStream, MeasuredForgetsNoLevelThatASampleSaw) {
  Random random(13);
  for (int trial = 0; trial < 200; ++trial) {
    const dsp::LogicTrace wire = glitchy_wire(random);
    for (const UartReceiver& receiver : uart_receivers())
      ASSERT_EQ(read_often(receiver, wire, 0.3, 0.0005, random), receiver.receive(wire, baud, 0.3))
          << receiver.name << ' ' << trial;
  }
}

const UartReceiver* counted = nullptr;
std::size_t edges_read = 0;

UartReading read_counted(const dsp::LogicTrace& line, dsp::Hertz rate, double phase) {
  edges_read += line.edges().size();
  return counted->read(line, rate, phase);
}

/// A pulse, then a pause, each of a random length of bits up to these.
std::size_t times_read(double longest_pulse, double longest_pause) {
  Random random(12);
  const UartReceiver counting{"counting", true, read_counted};
  UartStream stream(counting, baud, 0);
  dsp::LogicTrace wire;
  edges_read = 0;
  for (dsp::Seconds at(0.002); wire.edges().size() < 20000; stream.take(wire))
    for (const double longest : {longest_pulse, longest_pause}) {
      wire.add_edge(at);
      at += uniform(random, longest / 300, longest) * dsp::period(baud);
    }
  return edges_read / wire.edges().size();
}

// What begins with all of the wire each time would read each edge thousands of times.
TEST(UartStream, ReadsAWireThatIsNeverIdleAFewTimesOnly) {
  for (const UartReceiver& receiver : uart_receivers()) {
    counted = &receiver;
    EXPECT_LT(times_read(3, 3), 12U) << "bytes, " << receiver.name;
    EXPECT_LT(times_read(0.0005, 3), 12U) << "glitches between samples, " << receiver.name;
    EXPECT_LT(times_read(0.4, 3), 12U) << "false starts alone, " << receiver.name;
  }
}

TEST(UartStream, GivesAByteAsSoonAsItsStopBitIsOver) {
  const dsp::LogicTrace wire = test::send({'A', 'B'}, baud);
  UartStream stream(*find_uart_receiver("mid-bit"), baud, 0);
  EXPECT_TRUE(stream.take(until(wire, dsp::Seconds(0.01) + 9 * dsp::period(baud))).empty());
  EXPECT_EQ(stream.take(until(wire, dsp::Seconds(0.01) + 10 * dsp::period(baud))).size(), 1U);
}

}  // namespace
}  // namespace protocol
