// Queries at the pace of a line: each has its time from when it has left, however many there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "lines.hpp"
#include "protocol/shared_node.hpp"

namespace protocol {
namespace {

using dsp::Seconds;

const Seconds byte_time = bits_per_byte * dsp::period(test::baud);
constexpr std::size_t n_variables = 60;

std::vector<std::string> query_names() {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < n_variables; ++i) all.push_back("Var" + std::to_string(100 + i));
  return all;
}

/// A node at a line that takes a byte each byte's time, and what comes of its queries.
class End {
 public:
  explicit End(const SharedNodeSettings& settings) : node_(settings) {}

  SharedNode& node() { return node_; }
  const std::vector<std::size_t>& answered() const { return answered_; }
  const std::vector<std::size_t>& late() const { return late_; }

  /// One byte's time, and the byte that leaves in it.
  std::optional<std::uint8_t> step(Seconds now) {
    if (line_.empty())
      for (const std::uint8_t byte : node_.transmit(now)) line_.push_back(byte);
    if (line_.empty()) return std::nullopt;
    const std::uint8_t byte = line_.front();
    line_.pop_front();
    return byte;
  }
  void hear(std::optional<std::uint8_t> byte, Seconds now) {
    if (!byte) return;
    const SharedNodeNews news = node_.receive({now, *byte, false});
    answered_.insert(answered_.end(), news.answered.begin(), news.answered.end());
    late_.insert(late_.end(), news.late.begin(), news.late.end());
  }

 private:
  SharedNode node_;
  std::deque<std::uint8_t> line_;
  std::vector<std::size_t> answered_, late_;
};

/// A asks B, which has a value of everything that has been said already.
class Asking : public testing::Test {
 protected:
  explicit Asking(Seconds full_set_every = Seconds(3600))
      : a({.address = 'A',
           .peer = 'B',
           .inbound = query_names(),
           .query_timeout = Seconds(5),
           .byte_time = byte_time}),
        b({.address = 'B',
           .peer = 'A',
           .outbound = query_names(),
           .full_set_every = full_set_every,
           .byte_time = byte_time}) {
    for (std::size_t i = 0; i < n_variables; ++i)
      EXPECT_FALSE(b.node().set(i, "12.34" + std::to_string(i)));
    b.node().transmit(Seconds(0));
  }

  void ask_all() {
    for (std::size_t i = 0; i < n_variables; ++i) a.node().ask(i);
  }
  void run_until(Seconds end) {
    for (; now_ < end; now_ += byte_time) {
      b.hear(a.step(now_), now_ + byte_time);
      a.hear(b.step(now_), now_ + byte_time);
    }
  }

  End a, b;

 private:
  Seconds now_{1};
};

class AskingABusyPeer : public Asking {
 protected:
  AskingABusyPeer() : Asking(Seconds(1)) {}
};

TEST_F(Asking, AllAtOnceAllAreAnsweredInTime) {
  ask_all();
  run_until(Seconds(60));
  EXPECT_EQ(a.node().counts().asked, n_variables);
  EXPECT_EQ(a.node().counts().timed_out, 0U);
  EXPECT_EQ(a.answered().size(), n_variables);
  EXPECT_TRUE(std::ranges::is_sorted(a.answered())) << "in the order of asking";
}

TEST_F(Asking, LeavesTimeForValues) {
  ask_all();
  std::size_t n = 0;
  for (; a.node().counts().asked < n_variables; ++n)
    EXPECT_LT(static_cast<double>(a.node().transmit(Seconds(1)).size()) * byte_time, Seconds(1.5));
  EXPECT_GT(n, 10U);
}

TEST_F(Asking, TimeBeginsWhenAQueryHasLeft) {
  for (const std::size_t variable : {7U, 3U}) a.node().ask(variable);
  const auto n = static_cast<double>(a.node().transmit(Seconds(1)).size());
  const Seconds first = Seconds(6) + n / 2 * byte_time, second = Seconds(6) + n * byte_time;
  const Seconds moment(1e-6);
  EXPECT_TRUE(a.node().give_up(first - moment).empty());
  EXPECT_EQ(a.node().give_up(first + moment), std::vector<std::size_t>{7});
  EXPECT_TRUE(a.node().give_up(second - moment).empty());
  EXPECT_EQ(a.node().give_up(second + moment), std::vector<std::size_t>{3});
}

TEST_F(Asking, AnAnswerGivesThoseBehindItTimeAndNoOthers) {
  for (const std::size_t variable : {7U, 3U, 9U}) a.node().ask(variable);
  a.node().transmit(Seconds(0));
  for (const std::uint8_t byte : shared_link_encode(
           {'A', 'B', {{SharedLinkFieldType::reply, "Var103"}, {SharedLinkFieldType::data, "1"}}}))
    a.hear(byte, Seconds(4));
  EXPECT_EQ(a.answered(), std::vector<std::size_t>{3});
  EXPECT_EQ(a.node().give_up(Seconds(8.9)), std::vector<std::size_t>{7});
  EXPECT_EQ(a.node().give_up(Seconds(9)), std::vector<std::size_t>{9});
}

// Its full set takes longer than a query may: what is given up is answered all the same.
TEST_F(AskingABusyPeer, WhatIsGivenUpIsAnsweredLate) {
  ask_all();
  run_until(Seconds(120));
  const SharedNodeCounts& counts = a.node().counts();
  EXPECT_EQ(counts.answered + counts.timed_out, n_variables);
  EXPECT_EQ(counts.answered, a.answered().size());
  EXPECT_GT(counts.timed_out, 0U);
  EXPECT_EQ(counts.answered_late, counts.timed_out);
  EXPECT_EQ(a.late().size(), counts.timed_out);
}

TEST_F(Asking, AnswersThatNobodyAskedForAreNotLate) {
  a.node().ask(0);
  run_until(Seconds(2));
  for (const std::uint8_t byte : shared_link_encode(
           {'A', 'B', {{SharedLinkFieldType::reply, "Var100"}, {SharedLinkFieldType::data, "1"}}}))
    a.hear(byte, Seconds(3));
  EXPECT_EQ(a.answered(), std::vector<std::size_t>{0});
  EXPECT_TRUE(a.late().empty());
}

}  // namespace
}  // namespace protocol
