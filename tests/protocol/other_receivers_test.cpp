#include <gtest/gtest.h>

#include <utility>

#include "lines.hpp"
#include "protocol/cosys.hpp"
#include "protocol/edge_timing.hpp"
#include "protocol/software_serial.hpp"

namespace protocol {
namespace {

using dsp::LogicTrace;
using dsp::Seconds;
using test::baud;
using test::is_clean;
using test::send;

const Bytes message = cosys_encode("IND 011111 OK");
const Seconds bit = dsp::period(baud);

bool is_heard_at(double ratio, UartReading (*read)(const LogicTrace&, dsp::Hertz)) {
  return is_clean(read(send(message, baud * ratio), baud).bytes, message);
}

// The last data bit is read 8.5 bits behind the fall: right from 8 / 8.5 to 9 / 8.5 of the rate. An
// unmodified sketch on a simulated ATmega328P was seen to hear all from .95 to 1.05.
TEST(UartSoftwareSerial, HearsRatesUpToHalfABitInEightAndAHalf) {
  for (double ratio = 0.945; ratio < 1.0551; ratio += 0.005)
    EXPECT_TRUE(is_heard_at(ratio, read_software_serial)) << ratio;
  EXPECT_FALSE(is_heard_at(0.94, read_software_serial));
  EXPECT_FALSE(is_heard_at(1.06, read_software_serial));
}

/// 0xFF with the pin low for 2 us around `at`, in bits from the fall.
std::uint8_t with_a_dip(double at) {
  LogicTrace line;
  line.add_edge(Seconds(0));
  line.add_edge(bit);
  line.add_edge(at * bit - Seconds(1e-6));
  line.add_edge(at * bit + Seconds(1e-6));
  line.observe_until(20 * bit);
  return read_software_serial(line, baud).bytes.front().value;
}

// 16 MHz / 600 / 4 = 6666 units of four cycles a bit, so bits are read 1/26667 bit early each.
TEST(UartSoftwareSerial, ReadsEachBitOnceInItsMiddle) {
  for (int i = 0; i < data_bits; ++i) {
    EXPECT_EQ(with_a_dip(1.5 + i), 0xFF & ~(1 << i)) << i;
    EXPECT_EQ(with_a_dip(1.5 + i - 0.01), 0xFF) << i;
    EXPECT_EQ(with_a_dip(1.5 + i + 0.01), 0xFF) << i;
  }
}

/// Two characters of which the second falls so many bits behind the first.
std::size_t characters_at(double second_fall) {
  LogicTrace both;
  both.add_edge(Seconds(0));
  both.add_edge(bit);
  send_byte(both, 0xFF, second_fall * bit, baud);
  both.observe_until(40 * bit);
  return read_software_serial(both, baud).bytes.size();
}

TEST(UartSoftwareSerial, ListensAgainAQuarterIntoTheStopBit) {
  EXPECT_EQ(characters_at(9.24), 1U);
  EXPECT_EQ(characters_at(9.26), 2U);
}

TEST(UartSoftwareSerial, APulseThatIsGoneBeforeThePinIsReadStartsNothing) {
  LogicTrace line;
  line.add_edge(Seconds(0.01));
  line.add_edge(Seconds(0.01) + Seconds(4e-6));
  const Seconds start(0.01 + 20e-6);
  send_byte(line, 'x', start, baud);
  line.observe_until(Seconds(0.1));
  const auto heard = read_software_serial(line, baud).bytes;
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].start, start);
  EXPECT_EQ(heard[0].value, 'x');
}

// A start bit and eight zeros are rounded in one: half a bit in nine.
TEST(UartEdgeTiming, HearsRatesUpToHalfABitInTheLongestPulse) {
  const Bytes zero{0};
  const auto is_heard = [&](double ratio) {
    return is_clean(read_edge_timing(send(zero, baud * ratio), baud).bytes, zero);
  };
  EXPECT_TRUE(is_heard(9 / 9.49));
  EXPECT_FALSE(is_heard(9 / 9.51));
  EXPECT_TRUE(is_heard(9 / 8.51));
  EXPECT_FALSE(is_heard(9 / 8.49));
  for (double ratio = 0.95; ratio < 1.0501; ratio += 0.005)
    EXPECT_TRUE(is_heard_at(ratio, read_edge_timing)) << ratio;
}

TEST(UartEdgeTiming, ForgetsPulsesOfLessThanHalfABitAndKeepsTheRestOfTheCharacter) {
  const auto heard = [](double width) {
    LogicTrace bent;
    bent.add_edge(Seconds(0));  // a start bit, and a pulse in what is 0xFF otherwise
    bent.add_edge(bit);
    bent.add_edge(5 * bit);
    bent.add_edge((5 + width) * bit);
    bent.observe_until(30 * bit);
    return read_edge_timing(bent, baud).bytes;
  };
  ASSERT_EQ(heard(0.49).size(), 1U);
  EXPECT_EQ(heard(0.49)[0].value, 0xFF);
  ASSERT_EQ(heard(0.51).size(), 1U);
  EXPECT_EQ(heard(0.51)[0].value, 0xEF);
}

TEST(UartEdgeTiming, BothEdgesOfAPulseMayMoveByAQuarterOfABit) {
  const auto bent = [](double by) {
    return test::bend_pulses(send(message, baud), [&](Seconds fall, Seconds rise) {
      return std::pair(fall - by * bit, rise + by * bit);
    });
  };
  EXPECT_TRUE(is_clean(read_edge_timing(bent(0.24), baud).bytes, message));
  EXPECT_FALSE(is_clean(read_edge_timing(bent(0.26), baud).bytes, message));
}

}  // namespace
}  // namespace protocol
