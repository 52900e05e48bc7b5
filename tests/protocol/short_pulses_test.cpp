// Zero bits as short pulses, and what a monostable makes of them.
#include "protocol/short_pulses.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lines.hpp"
#include "protocol/uart.hpp"

namespace protocol {
namespace {

using dsp::Hertz;
using dsp::LogicTrace;
using dsp::Seconds;

constexpr Hertz pulsed_baud(2400);
constexpr Seconds pulse_length(158e-6);  // Vishay's recommended coding of 2400 bit/s

LogicTrace in_pulses(Hertz rate, Seconds length) {
  LogicTrace line;
  Seconds at(1e-3);
  for (const std::uint8_t byte : Bytes{0x00, 0xFF, 0x55, 0xA7, 0x30})
    at = send_byte_in_pulses(line, byte, at, rate, length);
  line.observe_until(at + Seconds(5e-3));
  return line;
}

// 9 + 1 + 5 + 4 + 7 zero bits of start and data.
TEST(ShortPulses, AreOneForEachZeroBit) {
  const LogicTrace line = in_pulses(pulsed_baud, pulse_length);
  ASSERT_EQ(line.edges().size(), 2U * 26U);
  for (std::size_t i = 0; i < line.edges().size(); i += 2)
    EXPECT_NEAR((line.edges()[i + 1] - line.edges()[i]).value, pulse_length.value, 1e-12);
  for (std::size_t i = 2; i < 18; i += 2)  // zeros in a row
    EXPECT_NEAR((line.edges()[i] - line.edges()[i - 2]).value, 1 / pulsed_baud.value, 1e-12);
}

TEST(ShortPulses, OfNoLengthAreWholeBits) {
  LogicTrace line;
  send_byte(line, 0x35, Seconds(0), pulsed_baud);
  LogicTrace other;
  send_byte_in_pulses(other, 0x35, Seconds(0), pulsed_baud, Seconds(0));
  EXPECT_EQ(line, other);
}

/// The same edges later, and pulses longer or shorter by `longer`.
LogicTrace behind_a_module(const LogicTrace& line, Seconds longer) {
  LogicTrace pin;
  for (std::size_t i = 0; i < line.edges().size(); ++i)
    pin.add_edge(line.edges()[i] + Seconds(140e-6) + (i % 2 == 1 ? longer : Seconds(0)));
  pin.observe_until(line.end());
  return pin;
}

// Whatever the module makes of their lengths, and clocks 2 % apart, every receiver reads them.
TEST(ShortPulses, AreReadAsWholeBits) {
  const std::vector<int> sent{0x00, 0xFF, 0x55, 0xA7, 0x30};
  for (const double clock : {0.98, 1.0, 1.02})
    for (const double longer_us : {-60.0, 0.0, 120.0, 230.0}) {
      const LogicTrace pin =
          behind_a_module(in_pulses(clock * pulsed_baud, pulse_length), Seconds(longer_us * 1e-6));
      const LogicTrace line = whole_bits(pin, pulsed_baud);
      for (const auto& bytes :
           {receive_mid_bit(line, pulsed_baud), receive_atmega(line, pulsed_baud, 0.4)}) {
        ASSERT_EQ(bytes.size(), sent.size()) << clock << " " << longer_us;
        for (std::size_t i = 0; i < sent.size(); ++i) {
          EXPECT_EQ(bytes[i].value, sent[i]) << clock << " " << longer_us;
          EXPECT_FALSE(bytes[i].framing_error);
        }
      }
      if (longer_us > 0) continue;
      const auto without = receive_mid_bit(pin, pulsed_baud);
      EXPECT_TRUE(without.empty()) << "they are over in the middle of a bit";
    }
}

TEST(ShortPulses, WholeBitsKeepWhatIsLongerAndBeginAnewWithEachFall) {
  LogicTrace pin;
  for (const double ms : {1.0, 1.1, 1.2, 1.3, 5.0, 7.0}) pin.add_edge(Seconds(ms * 1e-3));
  pin.observe_until(Seconds(9e-3));
  const LogicTrace line = whole_bits(pin, Hertz(1000));
  ASSERT_EQ(line.edges().size(), 4U);
  const std::array<double, 4> wanted{1.0, 2.2, 5.0, 7.0};
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_NEAR(line.edges()[i].value, wanted[i] * 1e-3, 1e-12);
  EXPECT_TRUE(whole_bits(LogicTrace(true, Seconds(1)), Hertz(1000)).edges().empty());
  LogicTrace low(false, Seconds(1));
  low.add_edge(Seconds(0.5));
  EXPECT_EQ(whole_bits(low, Hertz(1000)), low);
}

}  // namespace
}  // namespace protocol
