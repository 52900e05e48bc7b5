#include "protocol/uart_stream.hpp"

#include <gtest/gtest.h>

#include "lines.hpp"

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
      line.flip_at(at);
      at += dsp::Seconds(uniform(random, 1e-5, 3e-3));
      line.flip_at(at);
      at += dsp::Seconds(uniform(random, 0, 0.01));
    }
  }
  line.observe_until(at + dsp::Seconds(0.05));
  return line;
}

/// The wire as it is known at `t`.
dsp::LogicTrace until(const dsp::LogicTrace& wire, dsp::Seconds t) {
  dsp::LogicTrace part(wire.initial());
  for (const dsp::Seconds flip : wire.flips())
    if (flip <= t) part.flip_at(flip);
  part.observe_until(t);
  return part;
}

TEST(UartStream, GivesTheBytesOfTheWholeWireWheneverItIsRead) {
  Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const dsp::LogicTrace wire = random_wire(random);
    for (const UartReceiver& receiver : uart_receivers()) {
      const double phase = uniform(random, 0, 1);
      const auto whole = receiver.receive(wire, baud, phase);
      UartStream stream(receiver, baud, phase);
      std::vector<UartByte> bytes;
      const double longest_step = trial % 2 == 0 ? 0.02 : 0.5;
      for (dsp::Seconds t(0); t < wire.end(); t += dsp::Seconds(uniform(random, 0, longest_step)))
        for (const UartByte& byte : stream.take(until(wire, t))) bytes.push_back(byte);
      for (const UartByte& byte : stream.take(wire)) bytes.push_back(byte);
      ASSERT_EQ(bytes, whole) << receiver.name << " " << trial;
      EXPECT_TRUE(stream.take(wire).empty());
    }
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
