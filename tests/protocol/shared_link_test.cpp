#include "protocol/shared_link.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <vector>

#include "lines.hpp"

namespace protocol {
namespace {

using test::Random;
using Type = SharedLinkFieldType;
using Outcome = SharedLinkOutcome;

const SharedLinkMessage seed_message{'A',
                                     'B',
                                     {{Type::index, "0"},
                                      {Type::data, "40.12345678"},
                                      {Type::data, "-113.12345678"},
                                      {Type::data, "85.6"},
                                      {Type::data, "22.1"}}};
const std::string seed_line = "[:AB|N0|D40.12345678|D-113.12345678|D85.6|D22.1|CD4]\r\n";

/// Byte number i starts at i seconds.
std::vector<SharedLinkFrame> decode(std::string_view stream, SharedLinkDecoder& decoder) {
  std::vector<SharedLinkFrame> frames;
  double t = 0;
  for (const char c : stream)
    if (auto frame = decoder.push({dsp::Seconds(t++), static_cast<std::uint8_t>(c), false}))
      frames.push_back(std::move(*frame));
  return frames;
}

std::vector<SharedLinkFrame> decode(std::string_view stream) {
  SharedLinkDecoder decoder;
  return decode(stream, decoder);
}

std::string line_of(const SharedLinkMessage& message) {
  const Bytes bytes = shared_link_encode(message);
  return {bytes.begin(), bytes.end()};
}

/// A message of which everything but perhaps the fields is right.
std::string checked(const std::string& text) {
  const std::string summed = ":" + text + "|C";
  const int sum = shared_link_checksum(summed);
  constexpr std::string_view digits = "0123456789ABCDEF";
  return "[" + summed + digits[static_cast<std::size_t>(sum / 16)] +
         digits[static_cast<std::size_t>(sum % 16)] + "]";
}

SharedLinkMessage random_link_message(Random& random) {
  const auto address = [&] { return static_cast<char>('A' + random() % 16); };
  SharedLinkMessage message{address(), address(), {}};
  constexpr std::array types{Type::index, Type::data, Type::query, Type::reply};
  for (std::size_t n = random() % 8; n > 0; --n) {
    std::string text(random() % 20, ' ');
    for (char& c : text) do
        c = static_cast<char>(' ' + random() % 95);
      while (c == '[' || c == ']' || c == '|');
    message.fields.push_back({types[random() % 4], text});
  }
  return message;
}

TEST(SharedLink, WhatPeopleWriteHasNoFormat) {
  EXPECT_EQ(shared_link_text(seed_message), "AB|N0|D40.12345678|D-113.12345678|D85.6|D22.1");
  SharedLinkMessage message;
  const auto problem = [&](const std::string& text) {
    return parse_shared_link(text, message).value_or("");
  };
  EXPECT_EQ(problem("AB"), "");
  EXPECT_TRUE(message.fields.empty());
  for (const char* text : {"", "A", "ABN0", ":AB|N0"})
    EXPECT_EQ(problem(text), "it does not begin with two addresses and a |") << text;
  for (const char* text : {"AB|", "AB||D", "AB|D|", "AB|C", "AB|d1"})
    EXPECT_NE(problem(text).find("does not begin with one of the letters NDQR"), std::string::npos)
        << text;
}

TEST(SharedLinkLaw, TextAndMessageAreTheSame) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const SharedLinkMessage message = random_link_message(random);
    SharedLinkMessage read;
    EXPECT_FALSE(parse_shared_link(shared_link_text(message), read));
    EXPECT_EQ(read, message);
  }
}

TEST(SharedLink, ShowsWhatHasNotEnded) {
  SharedLinkDecoder decoder;
  EXPECT_EQ(decoder.pending(), nullptr);
  decode("x[:AB|N", decoder);
  ASSERT_NE(decoder.pending(), nullptr);
  EXPECT_EQ(*decoder.pending(), ":AB|N");
  decode("]", decoder);
  EXPECT_EQ(decoder.pending(), nullptr);
}

TEST(SharedLink, VectorsOfTheProtocol) {
  EXPECT_EQ(line_of(seed_message), seed_line);
  const auto frames = decode(seed_line);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].outcome, Outcome::ok);
  EXPECT_EQ(frames[0].message, seed_message);
  EXPECT_EQ(frames[0].start.value, 0);
  EXPECT_EQ(frames[0].text, seed_line.substr(1, seed_line.size() - 4));
}

TEST(SharedLink, DecodingUndoesEncoding) {
  Random random(7);
  SharedLinkDecoder decoder;
  for (int i = 0; i < 2000; ++i) {
    const SharedLinkMessage message = random_link_message(random);
    ASSERT_FALSE(problem_in_message(message)) << *problem_in_message(message);
    const auto frames = decode(line_of(message), decoder);
    ASSERT_EQ(frames.size(), 1u);
    EXPECT_EQ(frames[0].outcome, Outcome::ok);
    EXPECT_EQ(frames[0].message, message);
  }
}

TEST(SharedLink, EitherCaseOfTheChecksum) {
  std::string line = seed_line;
  line.replace(line.find("CD4"), 3, "Cd4");
  EXPECT_EQ(decode(line).at(0).outcome, Outcome::ok);
}

TEST(SharedLink, EachRejectionHasItsName) {
  const auto outcome = [](const std::string& line) { return decode(line).at(0).outcome; };
  EXPECT_EQ(outcome("[:AB|D\x01|C00]"), Outcome::unprintable);
  EXPECT_EQ(outcome("[AB|D1|C00]"), Outcome::no_header);
  EXPECT_EQ(outcome("[]"), Outcome::no_header);
  EXPECT_EQ(outcome("[:AQ|D1|C00]"), Outcome::bad_address);
  EXPECT_EQ(outcome("[:A|D1|C00]"), Outcome::bad_address);
  EXPECT_EQ(outcome("[:AB]"), Outcome::bad_address);
  EXPECT_EQ(outcome("[:AB|D1]"), Outcome::no_checksum);
  EXPECT_EQ(outcome("[:AB|]"), Outcome::no_checksum);
  EXPECT_EQ(outcome("[:AB|D1|CX0]"), Outcome::not_hex);
  EXPECT_EQ(outcome("[:AB|D1|C]"), Outcome::not_hex);
  EXPECT_EQ(outcome("[:AB|D1|C123]"), Outcome::not_hex);
  EXPECT_EQ(outcome("[:AB|D1|C00]"), Outcome::wrong_checksum);
  EXPECT_EQ(outcome(checked("AB|E1")), Outcome::unknown_field);
  EXPECT_EQ(outcome(checked("AB|C1|D1")), Outcome::unknown_field);
  EXPECT_EQ(outcome(checked("AB||D1")), Outcome::unknown_field);
  EXPECT_EQ(outcome(checked("AB")), Outcome::ok);
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < shared_link_outcomes; ++i)
    names.insert(name(static_cast<Outcome>(i)));
  EXPECT_EQ(names.size(), shared_link_outcomes);
  EXPECT_FALSE(names.contains(""));
}

TEST(SharedLink, BeginsAfreshAtTheNextBracket) {
  const auto frames = decode("D85.6|CD4]\r\n[:AB|D1" + seed_line + "garbage]]" + seed_line);
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_EQ(frames[0].outcome, Outcome::unended);
  EXPECT_EQ(frames[0].text, ":AB|D1");
  EXPECT_EQ(frames[1].message, seed_message);
  EXPECT_EQ(frames[1].start.value, 19);
  EXPECT_EQ(frames[2].message, seed_message);
}

TEST(SharedLink, MemoryIsBounded) {
  SharedLinkDecoder decoder(32);
  const auto frames =
      decode("[:AB|D" + std::string(1000000, '7') + "]" + checked("AB|D1"), decoder);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].outcome, Outcome::overlong);
  EXPECT_EQ(frames[0].text.size(), 28u);
  EXPECT_EQ(frames[1].outcome, Outcome::ok);
}

// The longest message that can be sent is the longest that is heard.
TEST(SharedLink, LimitsOfBothSidesAgree) {
  SharedLinkMessage longest{'A', 'P', {{Type::data, ""}}};
  while (!problem_in_message(longest)) longest.fields[0].text += '7';
  EXPECT_EQ(*problem_in_message(longest), "it would be 257 bytes long, 1 over the limit of 256");
  longest.fields[0].text.pop_back();
  EXPECT_EQ(line_of(longest).size(), 256u);
  EXPECT_EQ(decode(line_of(longest)).at(0).message, longest);
  longest.fields[0].text += '7';
  EXPECT_EQ(decode(line_of(longest)).at(0).outcome, Outcome::overlong);
}

TEST(SharedLink, WhatCannotBeSentHasAReason) {
  const auto problem = [](const SharedLinkMessage& m) {
    return problem_in_message(m).value_or("");
  };
  EXPECT_EQ(problem({'Q', 'B', {}}), "'Q' is no address, 'A' to 'P'");
  EXPECT_EQ(problem({'A', 'b', {}}), "'b' is no address, 'A' to 'P'");
  EXPECT_EQ(problem({'A', 'B', {{Type::data, "1|2"}}}), "'|' at position 1 belongs to the format");
  EXPECT_EQ(problem({'A', 'B', {{Type::query, "[x"}}}), "'[' at position 0 belongs to the format");
  EXPECT_EQ(problem({'A', 'B', {{Type::reply, "x]"}}}), "']' at position 1 belongs to the format");
  EXPECT_EQ(problem({'A', 'B', {{Type::data, "12\r"}}}),
            "byte 0x0d at position 2 is not printable ASCII, 0x20 to 0x7e");
  EXPECT_EQ(problem(seed_message), "");
}

// The sum sees every single bit.
TEST(SharedLink, NoSingleWrongBitPasses) {
  for (std::size_t at = 0; at < seed_line.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = seed_line;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      for (const SharedLinkFrame& frame : decode(damaged))
        EXPECT_TRUE(frame.outcome != Outcome::ok || frame.message == seed_message)
            << at << ' ' << bit;
    }
}

TEST(SharedLink, SurvivesAnyBytes) {
  Random random(9);
  SharedLinkDecoder decoder;
  for (int i = 0; i < 300; ++i) {
    Bytes bytes = test::random_bytes(random, 400);
    const std::string_view seeds = "[]:|CDNQRAB0";
    for (auto& byte : bytes)
      if (random() % 2 == 0) byte = static_cast<std::uint8_t>(seeds[random() % seeds.size()]);
    decode({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, decoder);
    const auto frames = decode(seed_line, decoder);
    ASSERT_FALSE(frames.empty());
    EXPECT_EQ(frames.back().message, seed_message);
  }
}

}  // namespace
}  // namespace protocol
