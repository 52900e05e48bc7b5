// What is believed at once, and what only because it was heard a few seconds ago.
#include "protocol/soft_judge.hpp"

#include <gtest/gtest.h>

#include "protocol/cosys.hpp"

namespace protocol {
namespace {

using dsp::Seconds;
using Characters = std::vector<SoftCharacter>;

constexpr double sure = 3;  // mismatch of any bit if it were the other

/// A character as a clear line has it, `mismatch` aside.
SoftCharacter character(std::uint8_t value, Seconds at, double mismatch) {
  SoftCharacter c{.start = at, .mismatch = mismatch};
  for (std::size_t i = 0; i < text_bits; ++i)
    c.darkness[i] = ((unsigned{value} >> i) & 1U) != 0 ? sure : -sure;
  return c;
}

Characters soft_line_of(const std::string& message, double at_s, double mismatch_a_character) {
  Characters line;
  for (const std::uint8_t byte : cosys_encode(message))
    line.push_back(character(byte, Seconds(at_s), mismatch_a_character));
  return line;
}

/// Believed alone; believed if it was heard; not believed.
Characters clear(const std::string& message, double at_s) {
  return soft_line_of(message, at_s, 0.55);
}
Characters weak(const std::string& message, double at_s) {
  return soft_line_of(message, at_s, 0.65);
}
Characters faint(const std::string& message, double at_s) {
  return soft_line_of(message, at_s, 1.05);
}

class Memory : public testing::Test {
 protected:
  void expect_heard(const Characters& line, const std::string& message) {
    const auto heard = judge_.judge(line);
    ASSERT_TRUE(heard.has_value()) << message;
    EXPECT_EQ(heard->message, message);
    EXPECT_FALSE(heard->repeated);
  }
  void expect_repeated(const Characters& line, const std::string& message) {
    const auto heard = judge_.judge(line);
    ASSERT_TRUE(heard.has_value()) << message;
    EXPECT_EQ(heard->message, message);
    EXPECT_TRUE(heard->repeated);
  }
  void expect_nothing(const Characters& line) { EXPECT_FALSE(judge_.judge(line).has_value()); }

  SoftJudge judge_{SoftMemory::of_messages};
};

TEST_F(Memory, MeasuredIsOfWhatWasHeardAloneWithinSixSeconds) {
  expect_nothing(weak("A", 0));
  expect_heard(clear("A", 1), "A");
  expect_repeated(weak("A", 6.9), "A");
  expect_nothing(weak("A", 7.1));
  expect_heard(clear("A", 8), "A");
  expect_repeated(weak("A", 13.9), "A");
}

TEST_F(Memory, MeasuredIsNotRenewedByWhatItMadeBelievable) {
  expect_heard(clear("A", 0), "A");
  expect_repeated(weak("A", 4), "A");
  expect_nothing(weak("A", 8));
}

TEST_F(Memory, MeasuredIsOfTheLatestTimeOfAMessage) {
  expect_heard(clear("A", 0), "A");
  expect_heard(clear("A", 4), "A");
  expect_repeated(weak("A", 9), "A");
}

TEST_F(Memory, MeasuredHelpsNoOtherMessage) {
  expect_heard(clear("IND 011111 OK", 0), "IND 011111 OK");
  expect_nothing(weak("IND 011110 OK", 1));
  expect_nothing(faint("IND 011111 OK", 1));
}

TEST_F(Memory, MeasuredHasRoomForEightMessages) {
  const std::string names = "BCDEFGHI";
  expect_heard(clear("A", 0), "A");
  for (const char name : names.substr(1)) expect_heard(clear({name}, 1), {name});
  expect_repeated(weak("A", 2), "A");
  for (int i = 0; i < 20; ++i) expect_heard(clear("I", 2), "I");
  expect_repeated(weak("A", 3), "A");
  expect_heard(clear({names[0]}, 3), {names[0]});
  expect_nothing(weak("A", 4));
}

TEST(SoftJudge, WithoutMemoryBelievesNothingMoreEasily) {
  SoftJudge judge(SoftMemory::none);
  EXPECT_TRUE(judge.judge(clear("A", 0)).has_value());
  EXPECT_FALSE(judge.judge(weak("A", 1)).has_value());
}

/// A bit of a line that is less sure.
struct Bit {
  std::size_t character, bit;
  double mismatch;  // of the bit that was sent over the other; negative: the other is the likelier
};

Characters with(Characters line, const std::vector<Bit>& bits) {
  for (const Bit& b : bits) {
    double& darkness = line[b.character].darkness[b.bit];
    darkness = (darkness > 0 ? 1 : -1) * b.mismatch;
  }
  return line;
}

bool is_believed(const Characters& line, const std::string& message) {
  const auto heard = SoftJudge(SoftMemory::none).judge(line);
  EXPECT_TRUE(!heard || heard->message == message) << heard->message;
  return heard.has_value();
}

bool is_repeated(const Characters& line, const std::string& message) {
  SoftJudge judge(SoftMemory::of_messages);
  judge.judge(clear(message, 0));
  const auto heard = judge.judge(line);
  EXPECT_TRUE(!heard || heard->message == message) << heard->message;
  return heard.has_value();
}

// One bit a column, so the checksum knows which: what is put right in all may be 1.5, or 3.
TEST(SoftJudge, PutsRightNoMoreThanItMay) {
  const std::string message = "IND 011111 OK";
  const auto wrong = [&](double first, double second) {
    return with(soft_line_of(message, 1, 0), {{0, 0, -first}, {4, 1, -second}});
  };
  EXPECT_TRUE(is_believed(wrong(0.9, 0.5), message));
  EXPECT_FALSE(is_believed(wrong(0.9, 0.7), message));
  EXPECT_TRUE(is_repeated(wrong(1.4, 1.5), message));
  EXPECT_FALSE(is_repeated(wrong(1.5, 1.6), message));
}

// Two bits of one column that are both the other way round have the same checksum.
TEST(SoftJudge, WantsOtherLinesToBeFurtherOff) {
  const std::string message = "IND 011111 OK";
  const auto doubtful = [&](double each) {
    return with(soft_line_of(message, 1, 0), {{2, 3, each}, {7, 3, each}});
  };
  EXPECT_TRUE(is_believed(doubtful(0.5), message));
  EXPECT_FALSE(is_believed(doubtful(0.4), message));
  EXPECT_TRUE(is_repeated(doubtful(0.15), message));
  EXPECT_FALSE(is_repeated(doubtful(0.05), message));
}

// A bit of the text and the same one of the checksum's digits: "0" and "1" are a bit apart.
TEST(SoftJudge, CountsLinesOfOtherChecksums) {
  const std::string message = "IND 011111 OK";  // 46
  const std::size_t digit = message.size() + 2;
  const auto doubtful = [&](double each) {
    return with(soft_line_of(message, 1, 0), {{5, 0, each}, {digit, 0, each}});
  };
  EXPECT_TRUE(is_believed(doubtful(0.5), message));
  EXPECT_FALSE(is_believed(doubtful(0.4), message));
}

TEST(SoftJudge, WantsSpaceNewlineAndChecksum) {
  const std::string message = "IND 011111 OK";
  const std::size_t space = message.size(), end = space + tail_size - 1;
  for (const std::size_t place : {space, space + 1, space + 2, end}) {
    Characters line = clear(message, 1);
    line[place] = character('y', Seconds(1), 0);
    EXPECT_FALSE(is_repeated(line, message)) << place;
  }
}

TEST(SoftJudge, TakesDigitsOfEitherCase) {
  const std::string message = "A*";  // 6b
  Characters line = clear(message, 1);
  EXPECT_TRUE(is_believed(line, message));
  for (const char c : {'b', 'B'}) {
    line[line.size() - 2] = character(static_cast<std::uint8_t>(c), Seconds(1), 0);
    EXPECT_TRUE(is_believed(line, message)) << c;
  }
}

}  // namespace
}  // namespace protocol
