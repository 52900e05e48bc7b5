// Frames between markers: what decoders that say nothing but messages are judged by.
#include "sim/check/delimited_stream.hpp"

#include <gtest/gtest.h>

#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "scenarios.hpp"
#include "sim/check/decoder.hpp"

namespace sim {
namespace {

constexpr FrameOutcome was_delivered{.delivered = true}, was_lost{}, was_unknown{.unknown = true},
    was_undetected_error{.undetected_error = true};

std::vector<FrameOutcome> marked_outcomes(const std::vector<std::string>& accepted) {
  return outcomes_between_markers(accepted, "A", 7, 3);
}

TEST(Markers, TellWhoseMessagesTheseAre) {
  EXPECT_EQ(marked_outcomes({"MARK #7", "A", "MARK #8", "MARK #9", "B", "MARK #10"}),
            (std::vector{was_delivered, was_lost, was_undetected_error}));
  EXPECT_EQ(
      marked_outcomes({"A", "MARK #7", "A", "B", "A", "MARK #8", "MARK #9", "A", "MARK #10", "A"}),
      (std::vector{FrameOutcome{.delivered = true, .undetected_error = true}, was_lost,
                   was_delivered}));
}

TEST(Markers, TellThatAMessageCameTwice) {
  const FrameOutcome twice{.delivered = true, .undetected_error = true};
  EXPECT_EQ(marked_outcomes({"MARK #7", "A", "A", "MARK #8", "A", "MARK #9", "A", "MARK #10"}),
            (std::vector{twice, was_delivered, was_delivered}));
}

TEST(Markers, ThatAreMissingLeaveTheFramesBesideThemUnknown) {
  EXPECT_EQ(marked_outcomes({}), (std::vector{was_unknown, was_unknown, was_unknown}));
  EXPECT_EQ(marked_outcomes({"MARK #7", "A", "MARK #9", "A", "MARK #10"}),
            (std::vector{was_unknown, was_unknown, was_delivered}));
  EXPECT_EQ(marked_outcomes({"A", "MARK #8", "A", "MARK #9", "A"}),
            (std::vector{was_unknown, was_delivered, was_unknown}));
}

TEST(Markers, OutOfTurnAreNone) {
  EXPECT_EQ(marked_outcomes({"MARK #7", "MARK #8", "MARK #7", "A", "MARK #9", "MARK #6", "MARK #99",
                             "MARK #10"}),
            (std::vector{was_lost, was_delivered, was_lost}));
}

TEST(Markers, HoldAllThatWasAcceptedOfOneTrial) {
  const auto between = [](const std::vector<std::string>& accepted) {
    return accepted_between_markers(accepted, 7);
  };
  using Messages = std::vector<std::string>;
  EXPECT_EQ(between({"MARK #7", "MARK #8"}), Messages{});
  EXPECT_EQ(between({"X", "MARK #7", "A", "A", "MARK #8", "B"}), (Messages{"A", "A"}));
  EXPECT_EQ(between({"MARK #7", "A"}), std::nullopt);
  EXPECT_EQ(between({"A", "MARK #8"}), std::nullopt);
  EXPECT_EQ(between({"MARK #8", "A", "MARK #7"}), std::nullopt);
  EXPECT_EQ(between({}), std::nullopt);
}

// "MARK 15" would be: 0x15 is the checksum of "MARK".
TEST(Markers, AreNeverTakenForAMessageWithItsChecksum) {
  for (std::uint32_t number = 0; number < 2000; ++number) {
    protocol::CosysDecoder decoder;
    for (const char c : marker(number) + "\n")
      if (const auto line = decoder.push({dsp::Seconds(0), static_cast<std::uint8_t>(c), false})) {
        EXPECT_NE(line->outcome, protocol::CosysOutcome::ok) << number;
      }
  }
}

TEST(Markers, AreNoMessagesOfDevices) {
  EXPECT_TRUE(is_like_marker(marker(0)));
  EXPECT_TRUE(is_like_marker(marker(4'000'000'000U)));
  for (const char* message :
       {"IND 011111 OK", "MARK", "MARK #", "MARK 15", "MARK #x", "MARK #1 2", "MARK #-1"})
    EXPECT_FALSE(is_like_marker(message)) << message;
}

JudgedLink judged(const std::vector<std::string>& set) { return {link_of(set), dsp::Hertz(600)}; }

std::vector<FrameOutcome> decoded(const JudgedLink& link, const std::string& decoder,
                                  std::uint32_t first, int n) {
  const DelimitedStream line = hear_delimited(link, first, n);
  return outcomes_between_markers(make_built_in_decoder(decoder)->decode(line).accepted,
                                  link.link.message, first, static_cast<std::size_t>(n));
}

TEST(DelimitedStream, GivesEveryDecoderEveryFrameOfAClearLink) {
  const JudgedLink link = judged(clear_link());
  for (const std::string& decoder : built_in_decoders())
    EXPECT_EQ(decoded(link, decoder, 40, 20), std::vector(20, was_delivered)) << decoder;
}

TEST(DelimitedStream, GivesNothingOfALinkInTheDark) {
  const JudgedLink link = judged({"receiver.range_m=100"});
  for (const std::string& decoder : built_in_decoders())
    EXPECT_EQ(decoded(link, decoder, 0, 9), std::vector(9, was_lost)) << decoder;
}

// The receiver's clock makes a link's times longer or shorter, not the markers'.
TEST(DelimitedStream, IsOnTheClockOfTheReceiver) {
  for (const char* error : {"uart.clock_error_ppm=40000", "uart.clock_error_ppm=-40000"})
    EXPECT_EQ(decoded(judged(clear_link({error})), "mid-bit", 0, 9), std::vector(9, was_delivered));
  for (const char* error : {"uart.clock_error_ppm=80000", "uart.clock_error_ppm=-80000"})
    EXPECT_EQ(decoded(judged(clear_link({error})), "mid-bit", 0, 9), std::vector(9, was_lost));
}

std::vector<std::uint64_t> light(const DelimitedStream& line) {
  std::vector<std::uint64_t> all;
  for (const FrameOnLine& frame : line.frames) all.push_back(frame.light);
  return all;
}

TEST(DelimitedStream, HashesTheLightOfEachFrameWhateverIsBesideIt) {
  const JudgedLink link = judged({"receiver.range_m=2.1"});
  const auto many = light(hear_delimited(link, 8, 16)), few = light(hear_delimited(link, 16, 3));
  EXPECT_EQ(std::vector(many.begin() + 8, many.begin() + 11), few);
  EXPECT_NE(many[0], many[1]);
  EXPECT_NE(light(hear_delimited(judged({"receiver.range_m=2.11"}), 16, 3)), few);
}

TEST(DelimitedStream, SaysWhereEachCharacterIs) {
  const JudgedLink link = judged(clear_link({"uart.clock_error_ppm=20000"}));
  const DelimitedStream line = hear_delimited(link, 0, 3);
  for (const FrameOnLine& frame : line.frames) {
    ASSERT_EQ(frame.byte_start.size(), link.link.bytes.size());
    for (std::size_t i = 0; i < frame.byte_start.size(); ++i)
      for (int slot = 0; slot < protocol::bits_per_byte; ++slot)
        EXPECT_EQ(line.wire.level_at(frame.byte_start[i] + frame.bit * (slot + 0.5)),
                  protocol::line_bit(link.link.bytes[i], slot));
    EXPECT_LT(frame.from, frame.byte_start.front());
    EXPECT_GT(frame.to, frame.byte_start.back() + frame.bit * 10);
  }
}

}  // namespace
}  // namespace sim
