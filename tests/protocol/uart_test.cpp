#include "protocol/uart_receivers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>

#include "lines.hpp"
#include "protocol/cosys.hpp"

namespace protocol {
namespace {

using dsp::Hertz;
using dsp::LogicTrace;
using dsp::Seconds;
using test::baud;
using test::is_clean;
using test::Random;
using test::send;

constexpr std::array phases = {0.0, 0.13, 0.25, 0.5, 0.77, 0.999};
const Seconds bit = dsp::period(baud);

/// The line is low from each `low[i]` for `width[i]` bits, in bits from time 0.
LogicTrace pulses(std::initializer_list<std::pair<double, double>> low_and_width,
                  double end_in_bits) {
  LogicTrace line;
  for (const auto& [low, width] : low_and_width) {
    line.add_edge(low * bit);
    line.add_edge((low + width) * bit);
  }
  line.observe_until(end_in_bits * bit);
  return line;
}

TEST(UartSend, SlotsAreStartDataStop) {
  for (int byte = 0; byte < 256; ++byte) {
    const auto value = static_cast<std::uint8_t>(byte);
    EXPECT_FALSE(line_bit(value, 0));
    EXPECT_TRUE(line_bit(value, 9));
    for (int i = 0; i < 8; ++i) EXPECT_EQ(line_bit(value, 1 + i), ((byte >> i) & 1) == 1);
  }
}

TEST(UartSend, LineHasTheLevelOfEverySlotAndEndsWithTheStopBit) {
  LogicTrace line;
  const Seconds start(0.25);
  const Hertz rate(612.5);
  const Seconds end = send_byte(line, 0x53, start, rate);
  EXPECT_DOUBLE_EQ(end.value, start.value + 10 / rate.value);
  EXPECT_EQ(line.end(), end);
  for (int slot = 0; slot < bits_per_byte; ++slot) {
    for (const double part : {0.001, 0.5, 0.999}) {
      EXPECT_EQ(line.level_at(start + (slot + part) * dsp::period(rate)), line_bit(0x53, slot));
    }
  }
}

TEST(UartReceivers, TableNamesAllAndNothingElse) {
  ASSERT_EQ(uart_receivers().size(), 4U);
  for (const auto& row : uart_receivers()) EXPECT_EQ(find_uart_receiver(row.name), &row);
  for (const char* name : {"atmega", "mid-bit", "software-serial", "edge-timing"})
    EXPECT_NE(find_uart_receiver(name), nullptr) << name;
  EXPECT_EQ(find_uart_receiver("8250"), nullptr);
  EXPECT_EQ(find_uart_receiver(""), nullptr);
}

TEST(UartReceivers, RowsAreTheFunctionsOfTheirNames) {
  const LogicTrace line = pulses({{10, 0.52}}, 40);  // in the middle low; votes high at phase .9
  const UartReceiver& mid_bit = *find_uart_receiver("mid-bit");
  const UartReceiver& atmega = *find_uart_receiver("atmega");
  EXPECT_EQ(mid_bit.receive(line, baud, 0), receive_mid_bit(line, baud));
  EXPECT_EQ(atmega.receive(line, baud, 0.9), receive_atmega(line, baud, 0.9));
  EXPECT_NE(mid_bit.receive(line, baud, 0.9), atmega.receive(line, baud, 0.9));
}

TEST(UartReceivers, RoundTripOfRandomBytesWithRandomGaps) {
  Random random(1);
  for (const auto& row : uart_receivers()) {
    for (const double phase : phases) {
      const Bytes sent = test::random_bytes(random, 300);
      LogicTrace line;
      std::vector<Seconds> starts;
      Seconds t(0.003);
      for (const auto byte : sent) {
        starts.push_back(t);
        t = send_byte(line, byte, t, baud) + Seconds(test::uniform(random, 0, 0.02));
      }
      const auto heard = row.receive(line, baud, phase);
      ASSERT_TRUE(is_clean(heard, sent)) << row.name << " phase " << phase;
      for (std::size_t i = 0; i < sent.size(); ++i) {
        EXPECT_GE(heard[i].start, starts[i]);
        EXPECT_LE((heard[i].start - starts[i]) / bit, 1.0 / 16 + 1e-9);
      }
    }
  }
}

TEST(UartReceivers, SilenceAndAStuckLineSayNothing) {
  for (const auto& row : uart_receivers()) {
    EXPECT_TRUE(row.receive(LogicTrace(true, Seconds(1)), baud, 0).empty());
    EXPECT_TRUE(row.receive(LogicTrace(false, Seconds(1)), baud, 0).empty());
    EXPECT_TRUE(row.receive(LogicTrace(), baud, 0).empty());
  }
}

TEST(UartReceivers, ABreakIsOneByteWithAFramingErrorHoweverLong) {
  for (const auto& row : uart_receivers()) {
    for (const double length : {10.5, 19.0, 19.6, 29.5, 100.0}) {
      const auto heard = row.receive(pulses({{5, length}}, 150), baud, 0.3);
      ASSERT_EQ(heard.size(), 1U) << row.name << ' ' << length;
      EXPECT_EQ(heard[0].value, 0);
      EXPECT_EQ(heard[0].framing_error, row.reads_stop_bits) << row.name;
    }
  }
}

TEST(UartReceivers, RecoverAfterABreak) {
  for (const auto& row : uart_receivers()) {
    LogicTrace line = pulses({{5, 23.3}}, 0);
    send_byte(line, 0xA5, 30 * bit, baud);
    const auto heard = row.receive(line, baud, 0.6);
    ASSERT_EQ(heard.size(), 2U) << row.name;
    EXPECT_EQ(heard[1].value, 0xA5);
    EXPECT_FALSE(heard[1].framing_error);
  }
}

TEST(UartReceivers, ACharacterCutOffByTheEndIsDropped) {
  for (const auto& row : uart_receivers()) {
    const LogicTrace whole = send({'A', 'B'}, baud, Seconds(0));
    for (double slots = 10; slots <= 20; slots += 0.05) {
      LogicTrace cut;
      for (const Seconds edge : whole.edges()) {
        if (edge <= slots * bit) cut.add_edge(edge);
      }
      cut.observe_until(slots * bit);
      const std::size_t bytes = row.receive(cut, baud, 0.1).size();
      EXPECT_GE(bytes, slots > 19.7 ? 2U : 1U) << row.name << ' ' << slots;
      EXPECT_LE(bytes, slots < (row.reads_stop_bits ? 19.4 : 19.2) ? 1U : 2U)
          << row.name << ' ' << slots;
    }
  }
}

/// In bits, to where it looks for the next. Half a bit may be taken for a whole one.
double shortest_character(const UartReceiver& receiver) {
  if (receiver.name == "edge-timing") return bits_per_byte / 2.0 - 1e-9;
  return receiver.reads_stop_bits ? 9.4 : 9.2;
}

TEST(UartReceivers, RandomEdgesNeverBreakTheRules) {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    LogicTrace line(random() % 2 == 0);
    const double mean = std::array{0.02, 0.3, 1.0, 5.0}[random() % 4];
    Seconds t;
    for (int i = 0; i < 300; ++i) line.add_edge(t += test::uniform(random, 0, 2 * mean) * bit);
    line.observe_until(t + test::uniform(random, 0, 12) * bit);
    for (const auto& row : uart_receivers()) {
      Seconds free(-1);
      for (const auto& byte : row.receive(line, baud, test::uniform(random, 0, 1))) {
        EXPECT_GE(byte.start, free);  // no character begins before the stop bit of the last
        free = byte.start + shortest_character(row) * bit;
        EXPECT_LE(free, line.end());
      }
    }
  }
}

TEST(UartMidBit, AFalseStartIsCountedAndYieldsNoByte) {
  std::vector<Seconds> false_starts;
  LogicTrace line = pulses({{5, 0.49}, {7, 0.01}}, 0);
  send_byte(line, 'x', 9 * bit, baud);
  const auto heard = receive_mid_bit(line, baud, &false_starts);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0], (UartByte{9 * bit, 'x', false}));
  EXPECT_EQ(false_starts, (std::vector{5 * bit, 7 * bit}));
}

TEST(UartMidBit, ReadsTheMiddleOfEachBitAndNothingElse) {
  for (int slot = 1; slot < bits_per_byte; ++slot) {
    // 1s but for a dip at one sampling instant, then just beside it
    const auto at = receive_mid_bit(pulses({{5, 0.6}, {5 + slot + 0.49, 0.02}}, 30), baud);
    const auto off = receive_mid_bit(pulses({{5, 0.6}, {5 + slot + 0.51, 0.02}}, 30), baud);
    ASSERT_GE(at.size(), 1U);
    ASSERT_GE(off.size(), 1U);
    EXPECT_EQ(at[0].value, slot == 9 ? 0xFF : 0xFF & ~(1 << (slot - 1)));
    EXPECT_EQ(at[0].framing_error, slot == 9);
    EXPECT_EQ(off[0].value, 0xFF);
    EXPECT_FALSE(off[0].framing_error);
  }
}

// sigrok-cli 0.7.2 with libsigrokdecode 0.5.3, measured on "IND 011111 OK 46\n" sent back to back:
// clean for line rates of 0.95 to 1.05 of 600; 0.945 right but for framing errors; beyond wrong.
TEST(UartMidBit, ToleratesTheRatesThatSigrokWasMeasuredToTolerate) {
  const Bytes sent = cosys_encode("IND 011111 OK");
  const auto at = [&](double ratio) { return receive_mid_bit(send(sent, baud * ratio), baud); };
  for (double ratio = 0.95; ratio < 1.0501; ratio += 0.005) {
    EXPECT_TRUE(is_clean(at(ratio), sent)) << ratio;
  }
  EXPECT_EQ(test::values(at(0.945)), sent);
  EXPECT_EQ(test::framing_errors(at(0.945)), sent.size());
  EXPECT_NE(test::values(at(0.94)), sent);
  EXPECT_NE(test::values(at(1.055)), sent);
}

TEST(UartAtmega, TwoOfSamples8To10Decide) {
  // dips over single samples of bit 3 of 0xFF; tick k of the receiver is at k/16 bit (phase 0)
  const auto value = [](double first_tick, double ticks) {
    const double from = 5 + 3 + (first_tick - 1 - 0.5) / 16;  // sample numbers begin at 1
    const auto heard = receive_atmega(pulses({{5, 0.9}, {from, ticks / 16}}, 30), baud);
    return heard.empty() ? -1 : int{heard[0].value};
  };
  for (int sample = 1; sample <= 16; ++sample) EXPECT_EQ(value(sample, 1), 0xFF) << sample;
  EXPECT_EQ(value(6, 2), 0xFF);
  EXPECT_EQ(value(7, 2), 0xFF);
  EXPECT_EQ(value(8, 2), 0xFB);
  EXPECT_EQ(value(9, 2), 0xFB);
  EXPECT_EQ(value(10, 2), 0xFF);
  EXPECT_EQ(value(1, 8), 0xFF);
  EXPECT_EQ(value(1, 9), 0xFB);
}

TEST(UartAtmega, AStartBitIsRejectedByItsVote) {
  for (const double phase : phases) {
    EXPECT_TRUE(receive_atmega(pulses({{5, 7.9 / 16}}, 30), baud, phase).empty());
    EXPECT_EQ(receive_atmega(pulses({{5, 9.1 / 16}}, 30), baud, phase).size(), 1U);
  }
}

TEST(UartAtmega, SeesNoGlitchBetweenItsTicks) {
  const LogicTrace line = pulses({{5 + 0.2 / 16, 0.6 / 16}, {6, 9}, {15.1, 0.01}}, 40);
  const auto heard = receive_atmega(line, baud, 0);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].value, 0);
  EXPECT_FALSE(heard[0].framing_error);
}

TEST(UartAtmega, AfterAFramingErrorItNeedsAHighSampleFirst) {
  const double low_until = 5 + 12;  // low through the stop bit and on
  const auto heard = receive_atmega(pulses({{5, 12}, {low_until + 0.5, 1}}, 40), baud, 0);
  ASSERT_EQ(heard.size(), 2U);
  EXPECT_TRUE(heard[0].framing_error);
  EXPECT_NEAR(heard[1].start / bit, low_until + 0.5, 1.0 / 16 + 1e-9);
  EXPECT_EQ(heard[1].value, 0xFF);
}

/// Sends random bytes back to back at `ratio` of the receiver's rate, at every clock phase.
bool clean_at_every_phase(double ratio) {
  Random random(3);
  for (const double phase : phases) {
    const Bytes sent = test::random_bytes(random, 2000);
    const auto line = send(sent, baud * ratio);
    if (!is_clean(receive_atmega(line, baud, phase), sent)) return false;
  }
  return true;
}

// Acceptance test U1: ATmega328P data sheet, receiver error tolerance at normal speed, D = 8:
// R_slow 95.36 %, R_fast 104.58 %, that is -4.54 to +4.58 %.
TEST(UartAtmega, U1ToleratesAClockErrorOf4Point5PercentAndNoMoreThan5) {
  for (const double percent : {-4.5, -4.0, -3.0, -2.0, -0.5, 0.0, 0.02, 1.0, 2.5, 4.0, 4.5}) {
    EXPECT_TRUE(clean_at_every_phase(1 + percent / 100)) << percent << " %";
  }
  for (const double percent : {-12.0, -8.0, -6.0, -5.5, 5.05, 5.5, 6.0, 8.0, 12.0}) {
    EXPECT_FALSE(clean_at_every_phase(1 + percent / 100)) << percent << " %";
  }
}

// The limits from first principles, in ticks of 1/16 bit after the first low sample, which comes up
// to one tick after the edge. Fast: the next start may fall right after sample 9 of the stop bit,
// 160/R - 1 > 152: R < 160/153, the data sheet's R_fast. Slow: samples 9 and 10 outvote sample 8,
// 144/R <= 152: R >= 144/152; the data sheet asks sample 8 too (144/151) and is that much safer.
TEST(UartAtmega, FailsWhereTheMajorityOfTheStopBitDoes) {
  EXPECT_TRUE(clean_at_every_phase(160.0 / 153 - 2e-4));
  EXPECT_FALSE(clean_at_every_phase(160.0 / 153 + 1e-3));
  EXPECT_TRUE(clean_at_every_phase(144.0 / 152 + 2e-4));
  EXPECT_FALSE(clean_at_every_phase(144.0 / 152 - 1e-3));
}

constexpr Hertz carrier{56000};
constexpr Seconds longest{6 / carrier.value};    // Vishay 82459 rev 1.8, p. 2: t_po - t_pi within
constexpr Seconds shortest{-5 / carrier.value};  // -5 to +6 cycles of the carrier

/// A pulse made longer by `change` at its trailing edge, or at its leading one.
std::pair<Seconds, Seconds> bent(Seconds fall, Seconds rise, Seconds change, bool at_the_end) {
  return at_the_end ? std::pair(fall, rise + change) : std::pair(fall - change, rise);
}

// Acceptance test U2: U1 with the module's pulse distortion, T_rx / T_tx within .9605 to 1.0335.
TEST(UartAtmega, U2ToleratesBentPulsesAndAClockErrorAtOnce) {
  Random random(4);
  for (const double ratio : {0.961, 0.97, 0.985, 1.0, 1.015, 1.025, 1.033}) {
    for (const double phase : phases) {
      const Bytes sent = test::random_bytes(random, 1000);
      const LogicTrace straight = send(sent, baud * ratio);
      const auto clean = [&](auto bend) {
        return is_clean(receive_atmega(test::bend_pulses(straight, bend), baud, phase), sent);
      };
      for (const bool end : {false, true}) {
        EXPECT_TRUE(clean([&](Seconds f, Seconds r) { return bent(f, r, longest, end); })) << ratio;
        EXPECT_TRUE(clean([&](Seconds f, Seconds r) { return bent(f, r, shortest, end); }))
            << ratio;
      }
      EXPECT_TRUE(clean([&](Seconds f, Seconds r) {
        return bent(f, r, random() % 2 == 0 ? longest : shortest, random() % 2 == 0);
      })) << ratio;
      EXPECT_TRUE(clean([&](Seconds f, Seconds r) {
        const Seconds change(test::uniform(random, shortest.value, longest.value));
        return bent(f, r, change, random() % 2 == 0);
      })) << ratio;
    }
  }
}

TEST(UartAtmega, BentPulsesTakeTheirShareOfTheTolerance) {
  Random random(5);
  const Bytes sent = test::random_bytes(random, 2000);
  const auto clean = [&](double ratio) {
    const auto line = test::bend_pulses(send(sent, baud * ratio), [&](Seconds f, Seconds r) {
      return bent(f, r, random() % 2 == 0 ? longest : shortest, random() % 2 == 0);
    });
    return is_clean(receive_atmega(line, baud, 0.4), sent);
  };
  EXPECT_TRUE(clean(1.033));
  EXPECT_FALSE(clean(1.04));   // clean without the bending
  EXPECT_FALSE(clean(0.953));  // likewise
}

}  // namespace
}  // namespace protocol
