// Bytes leave at the pace of a line, messages leave whole.
#include "sim/node/paced_output.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

namespace sim {
namespace {

using dsp::Seconds;

protocol::Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

/// Takes at most so many of what is due.
std::string take(PacedOutput& output, Seconds now, std::size_t most = std::string::npos) {
  const auto due = output.due(now);
  std::string taken(due.begin(),
                    due.begin() + static_cast<std::ptrdiff_t>(std::min(most, due.size())));
  output.take(taken.size(), now);
  return taken;
}

TEST(PacedOutput, ByteByByteAtDeadlinesThatDoNotDrift) {
  PacedOutput output(dsp::Hertz(10));  // a byte a second
  output.push(bytes_of("abcdefgh\n"), Seconds(100));
  EXPECT_EQ(take(output, Seconds(100)), "a");
  EXPECT_EQ(take(output, Seconds(100.9)), "");
  EXPECT_EQ(output.next().value, 101);
  EXPECT_EQ(take(output, Seconds(101.4)), "b");
  EXPECT_EQ(output.next().value, 102);
  EXPECT_EQ(take(output, Seconds(104.5)), "cde");  // the process had no time before
  EXPECT_EQ(take(output, Seconds(200)), "fgh\n");
  EXPECT_TRUE(output.is_empty());
  output.push(bytes_of("i\n"), Seconds(108.5));  // the line is busy until 109
  EXPECT_EQ(take(output, Seconds(108.9)), "");
  EXPECT_EQ(take(output, Seconds(109)), "i");
}

TEST(PacedOutput, APortThatTakesNothingIsTriedAgainLater) {
  PacedOutput output(dsp::Hertz(10));
  output.push(bytes_of("ab\ncd\nef\n"), Seconds(0));
  EXPECT_EQ(take(output, Seconds(0)), "a");
  EXPECT_FALSE(output.is_stuck());
  EXPECT_EQ(take(output, Seconds(1), 0), "");
  EXPECT_TRUE(output.is_stuck());
  EXPECT_GT(output.next(), Seconds(1));
  EXPECT_EQ(output.drop_unbegun(), 2U);
  output.push(bytes_of("gh\n"), Seconds(2));
  EXPECT_EQ(output.drop_unbegun(), 1U);
  output.push(bytes_of("ij\n"), Seconds(3));
  EXPECT_EQ(take(output, Seconds(100)), "b\nij\n");
  EXPECT_FALSE(output.is_stuck());
  EXPECT_EQ(output.drop_unbegun(), 0U);
}

// Whatever is taken and dropped, what left are whole messages in their order, each once.
TEST(PacedOutputLaw, OnlyWholeMessagesLeave) {
  std::mt19937 random(1);
  for (int run = 0; run < 200; ++run) {
    PacedOutput output(dsp::Hertz(10));
    std::string left;
    std::size_t pushed = 0, dropped = 0;
    for (int turn = 0; turn < 100; ++turn) {
      const Seconds now(turn);
      for (auto n = random() % 3; n > 0; --n)
        output.push(bytes_of("<" + std::to_string(pushed++) + ">\n"), now);
      left += take(output, now, random() % 4);
      if (random() % 10 == 0) dropped += output.drop_unbegun();
    }
    left += take(output, Seconds(1e6));
    std::size_t messages = 0, last = 0;
    for (std::size_t at = 0; at < left.size(); ++messages) {
      const std::size_t end = left.find(">\n", at);
      ASSERT_EQ(left[at], '<') << left;
      const std::size_t number = std::stoul(left.substr(at + 1, end - at - 1));
      ASSERT_TRUE(messages == 0 || number > last) << left;
      last = number;
      at = end + 2;
    }
    ASSERT_EQ(messages + dropped, pushed);
  }
}

}  // namespace
}  // namespace sim
