#include "protocol/soft_decoder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "protocol/bit_timing.hpp"
#include "soft_lines.hpp"

namespace protocol {
namespace {

using dsp::LogicTrace;
using dsp::Seconds;
using test::baud;
using test::bit_time;
using test::Damage;
using test::damaged;
using test::heard_by;
using test::heard_by_soft;
using test::Random;
using test::Sender;
using test::uniform;
using Messages = std::vector<std::string>;

constexpr double most_clock_error = 0.05;

TEST(SoftDecoder, DeliversEveryMessageOfAClearLine) {
  Random random(1);
  for (const double late_ms : {0.0, 1.0, 10.0, 100.0})
    for (int i = 0; i < 300; ++i) {
      Sender sender(random);
      sender.rate = baud * (1 + uniform(random, -most_clock_error, most_clock_error));
      sender.most_late = Seconds(late_ms / 1000);
      sender.idle(uniform(random, 1, 100));
      const std::string message = test::random_message(random, 40);
      const Seconds start = sender.send(message);
      sender.idle(uniform(random, 0, 100));
      const auto heard = decode_soft(sender.line(), baud, SoftMemory::none);
      ASSERT_EQ(heard.size(), 1U) << late_ms << ' ' << message;
      EXPECT_EQ(heard[0].message, message);
      EXPECT_NEAR(heard[0].start.value, start.value, 1e-9);
      EXPECT_FALSE(heard[0].repeated);
    }
}

TEST(SoftDecoder, DeliversWhatIsSentBackToBack) {
  Random random(2);
  for (const double error : {-most_clock_error, 0.0, most_clock_error}) {
    Sender sender(random);
    sender.rate = baud * (1 + error);
    Messages sent;
    for (int i = 0; i < 300; ++i) {
      sent.push_back(test::random_message(random, 40));
      sender.send(sent.back());
    }
    EXPECT_EQ(heard_by_soft(sender.line()), sent);
  }
}

// TSOP data sheets, output pulse width: tens to hundreds of microseconds; a bit is 1667.
TEST(SoftDecoder, IsNotDisturbedByPulsesThatAreAllLongerOrShorter) {
  Random random(3);
  for (double longer = -0.35; longer < 0.351; longer += 0.05)
    for (const double error : {-most_clock_error, 0.0, most_clock_error}) {
      Sender sender(random);
      sender.rate = baud * (1 + error);
      sender.idle(10);
      sender.send("IND 011111 OK");
      sender.idle(100);
      const LogicTrace bent = test::bend_pulses(sender.line(), [&](Seconds fall, Seconds rise) {
        return std::pair(fall, rise + longer * bit_time);
      });
      EXPECT_EQ(heard_by_soft(bent), Messages{"IND 011111 OK"}) << longer << ' ' << error;
    }
}

// Each start is known by the character behind it; the last has none.
TEST(SoftDecoder, NeedsNoStartBitOfACharacter) {
  const std::string message = "IND 011111 OK";
  for (std::size_t character = 0; character + 1 < message.size() + tail_size; ++character) {
    Random random(11);
    Sender sender(random);
    sender.idle(60);
    const Seconds from =
        sender.send(message) + static_cast<double>(character * bits_per_byte) * bit_time;
    sender.idle(60);
    LogicTrace line;
    for (Seconds t(0); t < sender.line().end(); t += 0.01 * bit_time) {
      const bool is_start = t >= from && t < from + bit_time;
      line.set_at(t, is_start || sender.line().level_at(t));
    }
    line.observe_until(sender.line().end());
    EXPECT_EQ(heard_by_soft(line, SoftMemory::none), Messages{message}) << character;
  }
}

/// Messages of many that a decoder hears, and how many others.
struct Tally {
  int right = 0, wrong = 0;

  void add(const Messages& heard, const std::string& sent) {
    right += std::ranges::find(heard, sent) != heard.end();
    wrong += static_cast<int>(std::ranges::count_if(heard, [&](auto& m) { return m != sent; }));
  }
};

Tally tally_of(const Damage& damage, const std::function<Messages(const LogicTrace&)>& decode) {
  Random random(4);
  Tally tally;
  for (int i = 0; i < 1000; ++i) {
    Sender sender(random);
    sender.rate = baud * (1 + uniform(random, -0.02, 0.02));
    sender.idle(60);
    const std::string message = test::random_message(random, 20);
    sender.send(message);
    sender.idle(60);
    tally.add(decode(damaged(sender.line(), damage, random)), message);
  }
  return tally;
}

TEST(SoftDecoder, MeasuredDeliversMoreThanPlainOnesAndAcceptsNoMoreWrongMessages) {
  for (const Damage& damage : {Damage{.holes = 0.1, .flashes = 0, .length = 0.15},
                               Damage{.holes = 0.5, .flashes = 0, .length = 0.15},
                               Damage{.holes = 0, .flashes = 0.3, .length = 0.15},
                               Damage{.holes = 0.1, .flashes = 0.1, .length = 0.2}}) {
    const Tally soft =
        tally_of(damage, [](auto& line) { return heard_by_soft(line, SoftMemory::none); });
    int wrong_of_plain = 0;
    for (const UartReceiver& plain : uart_receivers()) {
      const Tally other =
          tally_of(damage, [&](auto& line) { return heard_by(plain.name.data(), line); });
      EXPECT_GT(soft.right, other.right) << plain.name;
      wrong_of_plain = std::max(wrong_of_plain, other.wrong);
    }
    EXPECT_LE(soft.wrong, wrong_of_plain);
  }
}

/// The decoder without what tells holes from flashes.
Messages heard_evenly(const LogicTrace& line) {
  std::vector<LightPulse> light;
  for (std::size_t i = 0; i + 1 < line.edges().size(); i += 2)
    light.push_back({line.edges()[i], line.edges()[i + 1]});
  const BitTiming timing = estimate_bit_timing(light, bit_time);
  const auto characters =
      parse_characters(without_lengthening(light, timing.lengthening), timing.period);
  Messages messages;
  for (const SoftMessage& message : SoftLineFinder(SoftMemory::none).take(characters, true))
    messages.push_back(message.message);
  return messages;
}

TEST(SoftDecoder, MeasuredDeliversMoreByKnowingWhetherHolesOrFlashesAreRare) {
  for (const Damage& damage : {Damage{.holes = 0.5, .flashes = 0, .length = 0.2},
                               Damage{.holes = 0, .flashes = 0.3, .length = 0.2}}) {
    const Tally knowing =
        tally_of(damage, [](auto& line) { return heard_by_soft(line, SoftMemory::none); });
    const Tally even = tally_of(damage, heard_evenly);
    EXPECT_GT(even.right, 50);
    EXPECT_GT(knowing.right, even.right * 1.1) << damage.holes;
  }
}

// A line without its newline does not take the next one with it, if that comes behind a long pause.
TEST(SoftDecoder, BeginsALineBehindALongPause) {
  Random random(12);
  for (const double pause : {40.0, 70.0}) {
    Sender sender(random);
    sender.idle(60);
    Bytes unended = cosys_encode("IND 011111 OK");
    unended.back() = 'y';
    sender.send(unended);
    sender.idle(pause);
    sender.send("IND 011110 OK");
    sender.idle(60);
    EXPECT_EQ(heard_by_soft(sender.line()), pause > 60 ? Messages{"IND 011110 OK"} : Messages{});
  }
}

/// One character of a message, changed.
std::string changed(std::string message, Random& random) {
  char& c = message[random() % message.size()];
  const char old = c;
  while (c == old) c = static_cast<char>(' ' + random() % ('~' - ' ' + 1));
  return message;
}

// The last digit of a status that goes from 1 to 0 is one bit, and its checksum another.
TEST(SoftDecoder, MeasuredNeverRepeatsTheOldMessageWhereACharacterChanged) {
  Random random(5);
  int repeated = 0;
  for (const double holes : {0.5, 1.0, 1.5, 2.0, 3.0})
    for (const double flashes : {0.0, 0.2, 1.0})
      for (int i = 0; i < 200; ++i) {
        const std::string old =
            i % 2 == 0 ? "IND 011111 OK" : test::random_message(random, 16) + 'x';
        const std::string now = i % 4 == 0 ? "IND 011110 OK" : changed(old, random);
        for (const std::string& message : {now, old}) {
          Sender sender(random);
          sender.idle(60);
          sender.send(old);
          sender.idle(100);
          const Seconds start = sender.send(message) - 10 * bit_time;
          sender.idle(60);
          const auto heard =
              decode_soft(damaged(sender.line(), {holes, flashes, 0.15}, random, start), baud,
                          SoftMemory::of_messages);
          ASSERT_FALSE(heard.empty());
          ASSERT_EQ(heard[0].message, old);
          for (std::size_t k = 1; k < heard.size(); ++k) {
            EXPECT_FALSE(message == now && heard[k].message == old) << now;
            repeated += heard[k].repeated;
          }
        }
      }
  EXPECT_GT(repeated, 100);
}

/// A wire that changes by chance.
LogicTrace noise(double mean_dark, double mean_light, Seconds length, Random& random) {
  LogicTrace line;
  for (Seconds t(0); t < length;) {
    t += -std::log1p(-uniform(random, 0, 1)) * mean_dark * bit_time;
    line.add_edge(t);
    t += -std::log1p(-uniform(random, 0, 1)) * mean_light * bit_time;
    line.add_edge(t);
  }
  return line;
}

TEST(SoftDecoder, MeasuredAcceptsNoMoreOfNoiseThanPlainOnes) {
  Random random(6);
  std::size_t soft = 0, plain = 0;
  for (const double dark : {1.0, 3.0, 10.0})
    for (const double light : {0.3, 1.0, 2.0}) {
      const LogicTrace line = noise(dark, light, Seconds(600), random);
      soft += heard_by_soft(line).size();
      plain += heard_by("atmega", line).size();
    }
  EXPECT_LE(soft, plain);
}

// Text of which every second line has a checksum that a bit would make right.
TEST(SoftDecoder, CorrectsNothingThatIsSureToBeWrong) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    Sender sender(random);
    sender.idle(60);
    Bytes bytes = cosys_encode(test::random_message(random, 20) + "AB");
    bytes[random() % (bytes.size() - 4)] ^= static_cast<std::uint8_t>(1U << (random() % 7));
    sender.send(bytes);
    sender.idle(60);
    EXPECT_EQ(heard_by_soft(sender.line()), Messages{});
  }
}

TEST(SoftDecoder, HearsTheSameOfAWireThatComesInPieces) {
  Random random(8);
  Sender sender(random);
  for (int i = 0; i < 50; ++i) {
    sender.send(test::random_message(random, 20));
    sender.idle(uniform(random, 0, 80));
  }
  const LogicTrace line = damaged(sender.line(), {0.1, 0.02, 0.15}, random);
  SoftDecoder decoder(baud, SoftMemory::of_messages);
  std::vector<SoftMessage> heard;
  const auto add = [&](std::vector<SoftMessage> more) {
    heard.insert(heard.end(), more.begin(), more.end());
  };
  for (std::size_t i = 0; i < line.edges().size();) {
    const std::size_t n = std::min<std::size_t>(random() % 50, line.edges().size() - i);
    const auto piece = line.edges().subspan(i, n);
    i += n;
    add(decoder.take(piece, n == 0 ? Seconds(0) : piece.back()));
  }
  add(decoder.finish());
  EXPECT_EQ(heard, decode_soft(line, baud, SoftMemory::of_messages));
  EXPECT_GT(heard.size(), 30U);
}

// Behind an accepted line both its newline and a long pause say that a line begins: at one place.
TEST(SoftDecoder, ForgetsALineThatIsTooLongHoweverItBegan) {
  Random random(10);
  for (const double pause : {40.0, 100.0}) {
    Sender sender(random);
    sender.idle(60);
    sender.send("IND 011111 OK");
    sender.idle(pause);
    sender.send(Bytes(default_max_line, 'A'));
    sender.send("IND 011110 OK");
    sender.idle(60);
    EXPECT_EQ(heard_by_soft(sender.line()), Messages({"IND 011111 OK", "IND 011110 OK"})) << pause;
  }
}

// What it has not said yet is all that it can have kept.
TEST(SoftDecoder, KeepsNoMoreThanSomeThousandPulsesOfAWireWithoutPauses) {
  Random random(9);
  SoftDecoder decoder(baud, SoftMemory::none);
  Sender sender(random);
  std::size_t known = 0, said = 0, most_kept = 0, sent = 0;
  for (; sent < 2000; ++sent) {
    sender.send("IND 011111 OK");
    const auto edges = sender.line().edges().subspan(known);
    known += edges.size();
    said += decoder.take(edges, sender.line().end()).size();
    most_kept = std::max(most_kept, sent + 1 - said);
  }
  said += decoder.finish().size();
  EXPECT_LT(most_kept, 200U);
  EXPECT_GT(said, sent * 99 / 100);
}

}  // namespace
}  // namespace protocol
