// Two nodes at the ends of a line: what undamaged and damaged bytes do to their lists.
#include "protocol/shared_node.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "lines.hpp"

namespace protocol {
namespace {

using dsp::Seconds;
using test::Random;

std::vector<std::string> names(std::size_t n) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < n; ++i) all.push_back("Variable" + std::to_string(i));
  return all;
}

std::vector<std::string> data_of(const std::vector<SharedVariable>& list) {
  std::vector<std::string> all;
  for (const SharedVariable& variable : list) all.push_back(variable.value);
  return all;
}

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }
std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

/// What a stream changes, all of it heard at one time.
std::vector<std::size_t> hear(SharedNode& node, const Bytes& bytes, Seconds now = Seconds(0)) {
  std::vector<std::size_t> changed;
  for (const std::uint8_t byte : bytes)
    for (const std::size_t variable : node.receive({now, byte, false}).changed)
      changed.push_back(variable);
  return changed;
}

/// B sends its four variables to A.
struct Pair {
  SharedNode a, b;

  explicit Pair(std::size_t from_b = 4, std::size_t from_a = 0, bool compressed = true,
                std::size_t max_size = default_max_shared_link)
      : a({.address = 'A',
           .peer = 'B',
           .outbound = names(from_a),
           .inbound = names(from_b),
           .compressed = compressed,
           .max_size = max_size}),
        b({.address = 'B',
           .peer = 'A',
           .outbound = names(from_b),
           .inbound = names(from_a),
           .compressed = compressed,
           .max_size = max_size}) {}
};

void expect_set(SharedNode& node, std::size_t variable, const std::string& value) {
  const auto problem = node.set(variable, value);
  EXPECT_FALSE(problem) << *problem;
}

TEST(SharedNode, SendsTheMessageOfTheProtocol) {
  SharedNode b({.address = 'B',
                .peer = 'A',
                .outbound = {"AutoGpsLat", "AutoGpsLon", "AutoGpsHead", "AutoGpsVel"}});
  const std::vector<std::string> sent{"40.12345678", "-113.12345678", "85.6", "22.1"};
  for (std::size_t i = 0; i < 4; ++i) expect_set(b, i, sent[i]);
  EXPECT_EQ(text_of(b.transmit(Seconds(0))),
            "[:AB|N0|D40.12345678|D-113.12345678|D85.6|D22.1|CD4]\r\n");
  SharedNode a({.address = 'A', .peer = 'B', .inbound = names(4)});
  EXPECT_EQ(hear(a, bytes_of("[:AB|N0|D40.12345678|D-113.12345678|D85.6|D22.1|CD4]\r\n")),
            (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(data_of(a.inbound()), sent);
}

TEST(SharedNode, LeavesOutWhatHasNotChanged) {
  Pair pair;
  for (std::size_t i = 0; i < 4; ++i) expect_set(pair.b, i, std::to_string(i));
  hear(pair.a, pair.b.transmit(Seconds(0)), Seconds(0));
  EXPECT_EQ(text_of(pair.b.transmit(Seconds(0.3))), "");
  expect_set(pair.b, 1, "x");
  expect_set(pair.b, 3, "y");
  expect_set(pair.b, 2, "2");  // is that already
  const Bytes part = pair.b.transmit(Seconds(0.4));
  EXPECT_TRUE(text_of(part).starts_with("[:AB|N1|Dx|D|Dy|C")) << text_of(part);
  EXPECT_EQ(hear(pair.a, part, Seconds(0.4)), (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(pair.a.inbound()[2].at->value, 0);  // its age counts on
  EXPECT_EQ(pair.a.inbound()[3].at->value, 0.4);
  expect_set(pair.b, 0, "z");
  EXPECT_TRUE(text_of(pair.b.transmit(Seconds(0.9))).starts_with("[:AB|N0|Dz|C"));
  EXPECT_TRUE(text_of(pair.b.transmit(Seconds(1))).starts_with("[:AB|N0|Dz|Dx|D2|Dy|C"));
}

TEST(SharedNode, SplitsLongLists) {
  Pair pair(100, 0, true, 64);
  for (std::size_t i = 0; i < 100; ++i) expect_set(pair.b, i, "value " + std::to_string(i * 7919));
  const Bytes all = pair.b.transmit(Seconds(0));
  EXPECT_GT(pair.b.counts().sent, 20u);
  EXPECT_EQ(hear(pair.a, all).size(), 100u);
  EXPECT_EQ(data_of(pair.a.inbound()), data_of(pair.b.outbound()));
  EXPECT_EQ(pair.a.counts().accepted, pair.b.counts().sent);
}

TEST(SharedNode, QueriesAreAnsweredOrTimeOut) {
  Pair pair(4, 2);
  expect_set(pair.b, 2, "85.6");
  pair.b.transmit(Seconds(0));  // lost
  pair.a.ask(2);
  pair.a.ask(1);
  pair.a.ask(2);
  const Bytes asked = pair.a.transmit(Seconds(0.1));
  EXPECT_TRUE(text_of(asked).starts_with("[:BA|QVariable2|C")) << text_of(asked);
  hear(pair.b, asked, Seconds(0.2));
  EXPECT_EQ(pair.b.counts().unknown_asked, 1u);  // variable 1 has no value yet
  const Bytes answer = pair.b.transmit(Seconds(0.3));
  EXPECT_TRUE(text_of(answer).starts_with("[:AB|RVariable2|D85.6|C")) << text_of(answer);
  EXPECT_EQ(hear(pair.a, answer, Seconds(0.4)), (std::vector<std::size_t>{2}));
  EXPECT_EQ(pair.a.counts().asked, 2u);
  EXPECT_EQ(pair.a.counts().answered, 1u);
  EXPECT_EQ(pair.a.counts().timed_out, 0u);
  pair.a.transmit(Seconds(1.2));
  EXPECT_EQ(pair.a.counts().timed_out, 1u);
}

TEST(SharedNode, AQuestionAskedAgainStaysTheOneThatItWas) {
  Pair pair;  // of which nobody answers
  for (int i = 0; i < 4; ++i) {
    pair.a.ask(1);
    EXPECT_TRUE(text_of(pair.a.transmit(Seconds(0.3 * i))).starts_with("[:BA|QVariable1|C"));
  }
  EXPECT_EQ(pair.a.counts().asked, 1u);
  pair.a.give_up(Seconds(1));
  EXPECT_EQ(pair.a.counts().timed_out, 1u);
  pair.a.ask(1);
  pair.a.transmit(Seconds(1.1));
  EXPECT_EQ(pair.a.counts().asked, 2u);
}

TEST(SharedNode, SaysWhichQueriesWereAnsweredAndWhichWillNotBe) {
  Pair pair;
  expect_set(pair.b, 2, "85.6");
  hear(pair.a, pair.b.transmit(Seconds(0)));
  pair.a.ask(2);
  pair.a.ask(1);
  hear(pair.b, pair.a.transmit(Seconds(0)));
  std::vector<std::size_t> answered;
  for (const std::uint8_t byte : pair.b.transmit(Seconds(0.1))) {
    const SharedNodeNews news = pair.a.receive({Seconds(0.2), byte, false});
    EXPECT_TRUE(news.changed.empty());
    EXPECT_TRUE(news.answered.empty() || news.text.starts_with(":AB|RVariable2|D85.6|C"));
    answered.insert(answered.end(), news.answered.begin(), news.answered.end());
  }
  EXPECT_EQ(answered, std::vector<std::size_t>{2});
  EXPECT_TRUE(pair.a.give_up(Seconds(0.9)).empty());
  EXPECT_EQ(pair.a.give_up(Seconds(1)), std::vector<std::size_t>{1});
  EXPECT_TRUE(pair.a.give_up(Seconds(1)).empty());
  EXPECT_EQ(pair.a.counts().timed_out, 1u);
}

TEST(SharedNode, SendsAFullSetAgainIfTheLastGotLost) {
  Pair pair;
  for (std::size_t i = 0; i < 4; ++i) expect_set(pair.b, i, std::to_string(i));
  const Bytes all = pair.b.transmit(Seconds(0));
  EXPECT_EQ(text_of(pair.b.transmit(Seconds(0.1))), "");
  pair.b.resend();
  EXPECT_EQ(pair.b.transmit(Seconds(0.2)), all);
}

TEST(SharedNode, EachMisfitIsCounted) {
  SharedNode a({.address = 'A', .peer = 'B', .outbound = {"Own"}, .inbound = names(2)});
  expect_set(a, 0, "1");
  const auto message = [](char to, char from, const std::vector<SharedLinkField>& fields) {
    return shared_link_encode({to, from, fields});
  };
  using Field = SharedLinkFieldType;
  hear(a, message('C', 'B', {{Field::index, "0"}, {Field::data, "1"}}));
  hear(a, message('A', 'C', {{Field::index, "0"}, {Field::data, "1"}}));
  hear(a, message('B', 'A', {{Field::index, "0"}, {Field::data, "1"}}));
  hear(a, message('A', 'A', {{Field::index, "0"}, {Field::data, "1"}}));
  hear(a, message('A', 'B', {{Field::index, "3"}}));
  hear(a, message('A', 'B', {{Field::index, "-1"}, {Field::data, "1"}}));
  hear(a, message('A', 'B', {{Field::index, "1"}, {Field::data, "1"}, {Field::data, "2"}}));
  hear(a, message('A', 'B', {{Field::data, "1"}}));
  hear(a, message('A', 'B', {{Field::reply, "Variable0"}}));
  hear(a, message('A', 'B', {{Field::reply, "Variable0"}, {Field::query, "Own"}}));
  hear(a, message('A', 'B', {{Field::reply, "Nobody"}, {Field::data, "1"}}));
  hear(a, message('A', 'B', {{Field::query, "Nobody"}, {Field::query, "Own"}}));
  hear(a, bytes_of("[:AB|D1|C00]"));
  EXPECT_EQ(a.counts().for_others, 1u);
  EXPECT_EQ(a.counts().from_others, 1u);
  EXPECT_EQ(a.counts().from_self, 2u);
  EXPECT_EQ(a.counts().bad_index, 3u);
  EXPECT_EQ(a.counts().misplaced, 3u);
  EXPECT_EQ(a.counts().unknown_replies, 1u);
  EXPECT_EQ(a.counts().unknown_asked, 1u);
  EXPECT_EQ(a.counts().accepted, 2u);
  EXPECT_EQ(a.counts().rejected[static_cast<std::size_t>(SharedLinkOutcome::wrong_checksum)], 1u);
  EXPECT_EQ(data_of(a.inbound()), (std::vector<std::string>{"", ""})) << "nothing of a bad message";
}

TEST(SharedNode, WhatCannotBeIsRefused) {
  const auto problem = [](const SharedNodeSettings& s) { return problem_in_node(s).value_or(""); };
  EXPECT_EQ(problem({}), "");
  EXPECT_EQ(problem({.address = 'A', .peer = 'A'}), "the node and its peer have one address, 'A'");
  EXPECT_EQ(problem({.address = 'Q'}), "'Q' is no address, 'A' to 'P'");
  EXPECT_EQ(problem({.outbound = {"a", "b", "a"}}), "variable \"a\" is in the list twice");
  EXPECT_EQ(problem({.inbound = {""}}), "a variable has no name");
  EXPECT_EQ(problem({.inbound = {"a|b"}}),
            "variable \"a|b\": '|' at position 1 belongs to the format");
  EXPECT_NE(problem({.inbound = {std::string(300, 'a')}}).find("over the limit of 256"),
            std::string::npos);
  EXPECT_EQ(problem({.max_size = 2}), "it would be 11 bytes long, 9 over the limit of 2");
  Pair pair;
  EXPECT_EQ(pair.b.set(0, "").value_or(""),
            "an empty value cannot be sent: it says that nothing has changed");
  EXPECT_EQ(pair.b.set(0, "a]").value_or(""), "']' at position 1 belongs to the format");
  EXPECT_TRUE(pair.b.set(0, std::string(250, '7')));
  EXPECT_EQ(pair.b.outbound()[0].value, "");
}

/// A value that says whose it is.
std::string tagged(std::size_t variable, Random& random) {
  return std::to_string(variable) + ":" + std::to_string(random() % 1000);
}

/// Some outbound values anew.
void change(SharedNode& node, Random& random) {
  for (std::size_t i = 0; i < node.outbound().size(); ++i)
    if (random() % 3 == 0) expect_set(node, i, tagged(i, random));
}

/// One byte changed, lost or added.
Bytes damaged_line(Bytes bytes, Random& random) {
  if (bytes.empty()) return bytes;
  const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(random() % bytes.size());
  const auto byte = static_cast<std::uint8_t>(1 + random() % 255);
  switch (random() % 3) {
    case 0:
      *at = static_cast<std::uint8_t>(*at ^ byte);
      return bytes;
    case 1:
      bytes.erase(at);
      return bytes;
    default:
      bytes.insert(at, byte);
      return bytes;
  }
}

// Damage to each transmission in turn: no value ever is in another's place, and an undamaged full
// set makes both lists equal whatever was before.
TEST(SharedNodeLaw, DamageNeverMisplacesAValueAndAFullSetMendsAll) {
  Random random(3);
  for (int run = 0; run < 200; ++run) {
    Pair pair(1 + random() % 40, 1 + random() % 5, random() % 2 == 0, 40 + random() % 200);
    double now = 0;
    for (int turn = 0; turn < 20; ++turn, now += 0.3) {
      change(pair.b, random);
      hear(pair.a, damaged_line(pair.b.transmit(Seconds(now)), random), Seconds(now));
      for (std::size_t i = 0; i < pair.a.inbound().size(); ++i) {
        const std::string& value = pair.a.inbound()[i].value;
        ASSERT_TRUE(value.empty() || value.starts_with(std::to_string(i) + ":")) << i << value;
      }
    }
    hear(pair.a, pair.b.transmit(Seconds(now + 1)), Seconds(now + 1));
    ASSERT_EQ(data_of(pair.a.inbound()), data_of(pair.b.outbound()));
  }
}

TEST(SharedNodeLaw, CompressionNeverChangesWhatIsHeldInTheEnd) {
  Random random(5);
  for (int run = 0; run < 100; ++run) {
    const std::size_t n = 1 + random() % 30;
    Pair compressed(n, 0, true, 60), plain(n, 0, false, 60);
    std::size_t bytes = 0, plain_bytes = 0;
    for (int turn = 0; turn < 20; ++turn) {
      const Seconds now(0.05 * turn);
      Random same = random;
      change(compressed.b, random);
      change(plain.b, same);
      const Bytes few = compressed.b.transmit(now), all = plain.b.transmit(now);
      bytes += few.size();
      plain_bytes += all.size();
      hear(compressed.a, few, now);
      hear(plain.a, all, now);
      ASSERT_EQ(data_of(compressed.a.inbound()), data_of(plain.a.inbound()));
    }
    EXPECT_LE(bytes, plain_bytes);
  }
}

TEST(SharedNodeLaw, RecoversFromAnyGarbage) {
  Random random(6);
  Pair pair(6);
  for (std::size_t i = 0; i < 6; ++i) expect_set(pair.b, i, tagged(i, random));
  for (int run = 0; run < 500; ++run) {
    Bytes garbage = test::random_bytes(random, random() % 700);
    for (auto& byte : garbage)
      if (random() % 3 == 0) byte = static_cast<std::uint8_t>("[]:|AB"[random() % 6]);
    hear(pair.a, garbage, Seconds(run));
    const auto accepted = pair.a.counts().accepted;
    hear(pair.a, pair.b.transmit(Seconds(run)), Seconds(run));
    ASSERT_GT(pair.a.counts().accepted, accepted);
    ASSERT_EQ(data_of(pair.a.inbound()), data_of(pair.b.outbound()));
  }
}

}  // namespace
}  // namespace protocol
