// Polarity and bit rate found in random lines, and what the edges say of them.
#include "sim/capture/autobaud.hpp"

#include <gtest/gtest.h>

#include "capture_lines.hpp"
#include "sim/capture/line_statistics.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::LogicTrace;
using dsp::Seconds;
using test::Random;
using test::uniform;

LineFacts facts_of(const LogicTrace& line, bool inverted) {
  return survey_line({line.initial() != inverted, line.edges(), line.end()}, {}, {});
}

TEST(Autobaud, FindsPolarityAndRateOfAnyLine) {
  Random random(31);
  for (int trial = 0; trial < 300; ++trial) {
    const double baud = 200 * std::pow(1000, uniform(random, 0, 1));
    const test::LineFaults faults{uniform(random, -0.25, 0.25) / baud,
                                  uniform(random, 0, 0.03) / baud};
    const bool inverted = random() % 2 == 0;
    const LogicTrace line =
        test::bent_line(random, 1 + static_cast<int>(random() % 5), baud, faults);
    const LineFacts facts = facts_of(line, inverted);
    EXPECT_EQ(facts.inverted, inverted) << trial;
    EXPECT_NEAR(facts.baud.value / baud, 1, 0.026) << trial << ' ' << baud;
  }
}

// Alternating bits alone: two bits look as good as one, but for the pulses of light.
TEST(Autobaud, DoesNotTakeTwoBitsForOne) {
  LogicTrace line;
  Seconds at(0.05);
  for (int i = 0; i < 20; ++i) at = protocol::send_byte(line, 'U', at, Hertz(1200));
  line.observe_until(at + Seconds(0.05));
  EXPECT_EQ(facts_of(line, false).baud, Hertz(1200));
}

TEST(Autobaud, TakesAStandardRateThatIsNear) {
  Random random(32);
  for (const double error : {-0.02, -0.003, 0.0, 0.01, 0.02})
    EXPECT_EQ(facts_of(test::bent_line(random, 3, 600 * (1 + error), {}), false).baud, Hertz(600));
  const double odd = facts_of(test::bent_line(random, 3, 777, {}), false).baud.value;
  EXPECT_NEAR(odd, 777, 0.01);
}

TEST(Autobaud, KeepsWhatIsTold) {
  Random random(33);
  const LogicTrace line = test::bent_line(random, 3, 600, {});
  const LineFacts told = survey_line({true, line.edges(), line.end()}, true, Hertz(1234));
  EXPECT_TRUE(told.inverted);
  EXPECT_EQ(told.baud, Hertz(1234));
}

TEST(Autobaud, SilenceIsAnIdleLineOf600Baud) {
  for (const bool initial : {true, false}) {
    const LineFacts facts = survey_line({initial, {}, Seconds(1)}, {}, {});
    EXPECT_FALSE(facts.inverted);
    EXPECT_EQ(facts.baud, Hertz(600));
  }
}

TEST(Autobaud, AnyEdgesAtAllGiveARate) {
  Random random(34);
  for (int trial = 0; trial < 200; ++trial) {
    const LogicTrace line = test::random_trace(random, trial % 2 == 0, random() % 60);
    const double baud = facts_of(line, false).baud.value;
    EXPECT_TRUE(std::isfinite(baud) && baud > 0) << baud;
  }
}

TEST(Autobaud, TellsNoiseFromLines) {
  Random random(35);
  for (int trial = 0; trial < 50; ++trial) {
    const LogicTrace noise = test::random_trace(random, trial % 2 == 0, 400);
    EXPECT_TRUE(why_no_line(facts_of(noise, false))) << trial;
    const LogicTrace line = test::bent_line(random, 3, 600, {0.2 / 600, 0.05 / 600});
    EXPECT_EQ(why_no_line(facts_of(line, false)), std::nullopt) << trial;
  }
}

/// Pulses of light, each with as long a gap behind it; then two messages, of which a receiver may
/// lose the first with what it read of the pulses.
LogicTrace pulses_before(int pulses, double pulse_s) {
  LogicTrace line;
  Seconds at(0.05);
  for (int i = 0; i < 2 * pulses; ++i, at = at + Seconds(pulse_s)) line.add_edge(at);
  at = at + Seconds(0.1);
  for (int message = 0; message < 2; ++message)
    for (const std::uint8_t byte : protocol::cosys_encode("IND 011111 OK"))
      at = protocol::send_byte(line, byte, at, Hertz(600));
  line.observe_until(at + Seconds(0.05));
  return line;
}

TEST(Autobaud, FindsALineBehindSomethingElse) {
  for (const double pulse_s : {5e-6, 250e-6}) {
    const LineFacts facts = facts_of(pulses_before(500, pulse_s), false);
    EXPECT_EQ(facts.baud, Hertz(600)) << pulse_s;
    EXPECT_GE(facts.reading.messages, 1) << pulse_s;
  }
}

// Light for 100 us here and there: edges that are no character's.
TEST(Autobaud, FindsALineAmongGlitches) {
  LogicTrace line;
  Seconds at(0.05);
  for (int message = 0; message < 4; ++message, at = at + Seconds(0.2)) {
    for (int glitch = 0; glitch < 8; ++glitch, at = at + Seconds(7e-3)) {
      line.add_edge(at);
      line.add_edge(at + Seconds(100e-6));
    }
    for (const std::uint8_t byte : protocol::cosys_encode("IND 011111 OK"))
      at = protocol::send_byte(line, byte, at, Hertz(600));
  }
  line.observe_until(at);
  const LineFacts facts = facts_of(line, false);
  EXPECT_FALSE(facts.inverted);
  EXPECT_EQ(facts.baud, Hertz(600));
  EXPECT_EQ(facts.reading.messages, 4);
}

TEST(Autobaud, FindsMessagesBehindTextAtAnotherRate) {
  LogicTrace line;
  Seconds at(0.05);
  for (int i = 0; i < 8; ++i)
    for (const char c :
         std::string("Bootloader 1.2 of an unknown device, waiting for an image\r\n"))
      at = protocol::send_byte(line, static_cast<std::uint8_t>(c), at, Hertz(9600));
  at = at + Seconds(0.1);
  for (int message = 0; message < 2; ++message)
    for (const std::uint8_t byte : protocol::cosys_encode("IND 011111 OK"))
      at = protocol::send_byte(line, byte, at, Hertz(600));
  line.observe_until(at);
  EXPECT_EQ(facts_of(line, false).baud, Hertz(600));
}

TEST(Autobaud, FindsTextBehindABurst) {
  LogicTrace line;
  Seconds at(0.01);
  for (int i = 0; i < 2000; ++i, at = at + Seconds(2.5e-6 + 1e-6 * (i % 3))) line.add_edge(at);
  at = at + Seconds(0.01);
  for (int i = 0; i < 5; ++i)
    for (const char c : std::string("HELLO! BOOT0 is starting, and says much of what it does\r\n"))
      at = protocol::send_byte(line, static_cast<std::uint8_t>(c), at, Hertz(115200));
  line.observe_until(at + Seconds(0.01));
  EXPECT_EQ(facts_of(line, false).baud, Hertz(115200));
  EXPECT_FALSE(facts_of(line, false).inverted);
}

/// A bit more, at the place of the stop bit.
Seconds send_with_parity(LogicTrace& line, char c, Seconds at, Hertz baud) {
  const Seconds bit = dsp::period(baud);
  protocol::send_byte(line, static_cast<std::uint8_t>(c), at, baud);
  line.set_at(at + 9 * bit, std::popcount(static_cast<unsigned char>(c)) % 2 == 1);
  line.set_at(at + 10 * bit, true);
  return at + 11 * bit;
}

// Where characters tell little, the long pauses do: 8E1 here.
TEST(Autobaud, PausesTellTheIdleLevel) {
  Random random(36);
  for (int trial = 0; trial < 60; ++trial) {
    LogicTrace line;
    Seconds at(0.02);
    for (int text = 0; text < 3; ++text, at = at + Seconds(0.2))
      for (int letter = 0; letter < 20; ++letter)
        at = send_with_parity(line, static_cast<char>(' ' + random() % 95), at, Hertz(9600));
    line.observe_until(at);
    EXPECT_EQ(facts_of(line, trial % 2 == 0).inverted, trial % 2 == 0) << trial;
  }
}

TEST(Autobaud, CharactersWithAParityBitAreNot8N1) {
  LogicTrace line;
  Seconds at(0.05);
  for (const char c : std::string("Even parity makes half of these bad"))
    at = send_with_parity(line, c, at, Hertz(600));
  line.observe_until(at + Seconds(0.05));
  EXPECT_TRUE(why_no_line(facts_of(line, false)));
}

TEST(Autobaud, BytesThatAreNoTextAreALine) {
  Random random(38);
  LogicTrace line;
  Seconds at(0.05);
  for (int i = 0; i < 40; ++i)
    at = protocol::send_byte(line, static_cast<std::uint8_t>(0x80 | random()), at, Hertz(9600));
  line.observe_until(at);
  EXPECT_EQ(why_no_line(facts_of(line, false)), std::nullopt);
}

TEST(Autobaud, FindsNoRateThatTheSamplesCannotCarry) {
  Random random(37);
  for (int trial = 0; trial < 30; ++trial) {
    LogicTrace noise;
    Seconds at(1e-3);
    for (int i = 0; i < 400; ++i, at = at + Seconds(1e-6 * static_cast<double>(1 + random() % 20)))
      noise.add_edge(at);
    noise.observe_until(at);
    const LineFacts facts = survey_line({true, noise.edges(), noise.end(), Seconds(1e-5)}, {}, {});
    EXPECT_LE(facts.baud.value, 50e3) << trial;
  }
}

// Between two edges there is one level alone, which tells nothing.
TEST(Autobaud, OnePulseOnALineThatIsLowTellsThatItIdlesLow) {
  const std::vector<Seconds> edges{Seconds(0.1), Seconds(0.1016)};
  EXPECT_TRUE(survey_line({false, edges, Seconds(1)}, {}, Hertz(600)).inverted);
}

TEST(Autobaud, AClockIsNoLine) {
  LogicTrace clock;
  for (int i = 1; i < 400; ++i) clock.add_edge(Seconds(i / 9600.0));
  EXPECT_TRUE(why_no_line(facts_of(clock, false)));
}

// The beat of two carriers: a clock that slips now and then.
TEST(Autobaud, AClockThatSlipsIsNoLine) {
  LogicTrace clock;
  Seconds at(0.01);
  for (int i = 1; i < 2000; ++i, at = at + Seconds((i % 190 == 0 ? 1.5 : 1) / 9600.0))
    clock.add_edge(at);
  const auto why = why_no_line(facts_of(clock, false));
  EXPECT_TRUE(why.value_or("").ends_with("as those of a clock")) << why.value_or("none");
}

TEST(Autobaud, EdgesThatAreInNoCharacterMakeNoLine) {
  LogicTrace line;
  Seconds at(0.05);
  for (const char c : std::string("glitches")) {
    for (int i = 0; i < 200; ++i, at = at + Seconds(1e-3 + 1e-6 * (i % 7))) {
      line.add_edge(at);
      line.add_edge(at + Seconds(0.1e-6));
    }
    at = protocol::send_byte(line, static_cast<std::uint8_t>(c), at, Hertz(9600));
  }
  line.observe_until(at);
  EXPECT_TRUE(why_no_line(facts_of(line, false)).value_or("").starts_with("of 32"));
}

TEST(Autobaud, FewCharactersTellNoRate) {
  LogicTrace line;
  Seconds at(0.05);
  for (const char c : std::string("AB"))
    at = protocol::send_byte(line, static_cast<std::uint8_t>(c), at, Hertz(9600));
  line.observe_until(at + Seconds(0.05));
  EXPECT_TRUE(why_no_line(facts_of(line, false)));
  EXPECT_FALSE(why_no_line(survey_line({true, line.edges(), line.end()}, {}, Hertz(9600))));
}

/// Of the line read with a clock of 600 Bd.
LineStatistics statistics_of(const LogicTrace& line, std::size_t batch) {
  LineStatistics statistics(Hertz(600), line.initial());
  const auto bytes = protocol::receive_mid_bit(line, Hertz(600));
  std::size_t given = 0;
  for (std::size_t i = 0; i < line.edges().size(); i += batch) {
    const auto edges = line.edges().subspan(i, std::min(batch, line.edges().size() - i));
    std::size_t whole = given;
    while (whole < bytes.size() && bytes[whole].start + Seconds(10 / 600.0) <= edges.back())
      ++whole;
    statistics.add(edges, std::span(bytes).subspan(given, whole - given));
    given = whole;
  }
  statistics.add({}, std::span(bytes).subspan(given));
  return statistics;
}

// Standard errors: jitter / sqrt(2 edges) of the jitter, and of the others as much or less.
TEST(LineStatistics, MeasuresRateDistortionAndJitter) {
  Random random(35);
  for (const double error : {-0.01, 0.0, 0.013})
    for (const double distortion : {-120e-6, 0.0, 80e-6})
      for (const double jitter : {0.0, 5e-6, 30e-6}) {
        const LogicTrace line =
            test::bent_line(random, 60, 600 * (1 + error), {distortion, jitter});
        const auto fit = statistics_of(line, 100).fit();
        ASSERT_TRUE(fit);
        const double four_sigma = 4 * jitter / std::sqrt(2.0 * 60 * 15 * 3);
        EXPECT_NEAR(fit->baud.value / 600 - 1, error, four_sigma * 600 + 1e-9);
        EXPECT_NEAR(fit->distortion.value, distortion, 2 * four_sigma + 1e-10);
        EXPECT_NEAR(fit->jitter.value, jitter, four_sigma + 1e-9);
      }
}

TEST(LineStatistics, AreThoseOfTheWholeLineHoweverItComes) {
  Random random(36);
  const LogicTrace line = test::bent_line(random, 10, 603, {50e-6, 10e-6});
  const auto whole = statistics_of(line, 1'000'000);
  for (const std::size_t batch : {1U, 7U, 64U}) {
    const auto parts = statistics_of(line, batch);
    EXPECT_EQ(parts.characters(), whole.characters());
    EXPECT_DOUBLE_EQ(parts.fit()->jitter.value, whole.fit()->jitter.value);
  }
}

TEST(LineStatistics, SaysNothingOfWhatEdgesDoNotDetermine) {
  LogicTrace line;
  Seconds at(0.01);
  for (int i = 0; i < 30; ++i)  // falls in slot 0 and rises in slot 9 alone
    at = protocol::send_byte(line, 0, at, Hertz(600)) + Seconds(0.01);
  line.observe_until(at);
  EXPECT_FALSE(statistics_of(line, 1000).fit());
  EXPECT_EQ(statistics_of(line, 1000).characters(), 30U);
}

}  // namespace
}  // namespace sim
