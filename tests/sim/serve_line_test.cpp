// A line that is played, without its clock and port: which bytes, when, and what a decoder makes of
// them.
#include <algorithm>
#include <cmath>

#include "scenarios.hpp"
#include "sim/serve/line_decoder.hpp"
#include "sim/serve/line_message.hpp"
#include "sim/serve/line_player.hpp"
#include "sim/serve/message_ahead.hpp"
#include "sim/trace/trace.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

using dsp::Seconds;

const std::atomic<bool> going = false;

/// The stretch of a trial's receiver that a message is, by the trace of that trial.
std::vector<LineByte> traced_bytes(const std::vector<std::string>& set, std::uint32_t trial) {
  const Scenario point = point_scenario(loaded("", set), {});
  const Link link = make_link(point);
  const auto sent = transmit(link, trial).messages;
  const Seconds from = sent[sent.size() - 2].end, to = sent.back().end;
  std::vector<LineByte> bytes;
  for (const auto& byte : receive(link, trial, trace_trial(point, trial).rx).bytes)
    if (byte.start >= from && byte.start < to)
      bytes.push_back({byte.start - from + dsp::period(link.receiver_baud) * 9.5, byte.value,
                       byte.framing_error});
  return bytes;
}

std::vector<std::string> with_key(std::vector<std::string> set, const std::string& more) {
  set.push_back(more);
  return set;
}

TEST(LineMessage, HasTheBytesThatTheTraceOfItsTrialShows) {
  const std::vector<std::string> damaged{"simulation.warmup_messages=1", "receiver.range_m=3",
                                         "simulation.sample_rate_hz=250000"};
  const std::vector<std::vector<std::string>> lines{
      damaged,
      with_key(damaged, "simulation.fidelity=envelope"),
      with_key(damaged, "receiver.population=true"),
      {"simulation.warmup_messages=1", "receiver.module=ideal-coherent", "receiver.ebn0_db=7",
       "simulation.fidelity=decision"}};
  for (const auto& set : lines) {
    std::size_t damaged_messages = 0;
    for (std::uint32_t trial : {0U, 1U, 2U, 77U}) {
      const Link link = link_of(set);
      const LineMessage message = make_line_message(link, trial, going);
      EXPECT_EQ(message.bytes, traced_bytes(set, trial)) << set.back() << ' ' << trial;
      EXPECT_EQ(message.number, trial);
      damaged_messages += message.bytes.size() != link.bytes.size() ||
                          !std::ranges::equal(message.bytes, link.bytes, {}, &LineByte::value);
    }
    EXPECT_GT(damaged_messages, 0U) << set.back();
  }
}

TEST(LineMessage, IsAPauseAndCharactersOfTenBits) {
  const Link link = link_of(clear_link(
      {"device.interval_min_ms=150", "device.interval_max_ms=250", "uart.clock_error_ppm=100"}));
  const Seconds bit = dsp::period(link.device_baud);
  for (std::uint32_t k = 0; k < 4; ++k) {
    const LineMessage message = make_line_message(link, k, going);
    EXPECT_GE(message.start.value, 0.15);
    EXPECT_LE(message.start.value, 0.25);
    ASSERT_EQ(message.bytes.size(), link.bytes.size());
    const auto characters = static_cast<double>(link.bytes.size());
    EXPECT_NEAR(message.end.value, (message.start + bit * 10 * characters).value, 1e-9);
    for (std::size_t i = 0; i < link.bytes.size(); ++i) {
      EXPECT_EQ(message.bytes[i].value, link.bytes[i]);
      EXPECT_FALSE(message.bytes[i].framing_error);
      const Seconds read = message.start + bit * (10 * static_cast<double>(i) + 9.5) + link.delay;
      EXPECT_NEAR(message.bytes[i].at.value, read.value, bit.value / 4) << i;
    }
  }
}

TEST(LineMessage, CountsAsItsTrialDoes) {
  for (const char* range : {"receiver.range_m=1", "receiver.range_m=3"}) {
    const Link link = link_of({range, "device.interval_min_ms=300"});
    LineDecoder decoder;
    std::uint64_t ok = 0;
    for (std::uint32_t k = 0; k < 8; ++k)
      ok += decoder.hear(make_line_message(link, k, going)).outcome == "ok";
    EXPECT_EQ(ok, run_group(link, 0, 8).tally.n_frames_ok) << range;
  }
}

TEST(MessageAhead, MakesWhatWasBegunLast) {
  const auto near = std::make_shared<const Link>(link_of(clear_link()));
  const auto far = std::make_shared<const Link>(link_of({"receiver.range_m=900"}));
  MessageAhead ahead;
  for (int i = 0; i < 3; ++i) {
    ahead.begin(far, 4);
    ahead.begin(near, 5);
    while (!ahead.is_ready(std::chrono::milliseconds(100))) continue;
    const LineMessage message = ahead.take();
    EXPECT_EQ(message.number, 5U);
    EXPECT_EQ(message.bytes, make_line_message(*near, 5, going).bytes);
  }
  ahead.begin(near, 6);  // and leaves it
}

LineMessage message_of(const std::string& bytes, Seconds end = Seconds(1)) {
  LineMessage message{.number = 0, .sent = "IND 011111 OK", .start = {}, .end = end, .bytes = {}};
  for (std::size_t i = 0; i < bytes.size(); ++i)
    message.bytes.push_back(
        {Seconds(0.01 * static_cast<double>(i + 1)), static_cast<std::uint8_t>(bytes[i]), false});
  return message;
}

TEST(LineDecoder, NamesOutcomesAsDecodeDoes) {
  const std::vector<std::pair<std::string, std::string>> outcomes{
      {"IND 011111 OK 46\n", "ok"},
      {"x\nIND 011111 OK 46\n", "ok"},
      {"RFID S:U 05\n", "undetected"},
      {"IND 011111 OL 46\n", "wrong_checksum"},
      {"IND \xff 46\n", "unprintable"},
      {"IND 4g\n", "not_hex"},
      {"IND\n", "too_short"},
      {std::string(300, 'x') + "\n", "overlong"},
      {"", "nothing"},
      {"IND 011111 OK 46", "no newline"}};
  for (const auto& [bytes, outcome] : outcomes)
    EXPECT_EQ(LineDecoder().hear(message_of(bytes)).outcome, outcome) << bytes;
  EXPECT_EQ(LineDecoder().hear(message_of("A\n\x80")).heard, "A\\x0a\\x80");
}

// As the reader's decoder, which is told nothing of where messages begin.
TEST(LineDecoder, GoesOnInTheLineThatHasNotEnded) {
  LineDecoder decoder;
  EXPECT_EQ(decoder.hear(message_of("IND 011111 OK 46")).outcome, "no newline");
  EXPECT_EQ(decoder.hear(message_of("IND 011111 OK 46\n")).outcome, "wrong_checksum");
  EXPECT_EQ(decoder.hear(message_of("IND 011111 OK 46\n")).outcome, "ok");
}

TEST(LinePlayer, GivesEachByteAtItsInstantOnceAndInOrder) {
  LinePlayer player;
  EXPECT_EQ(player.next().value, std::numeric_limits<double>::infinity());
  player.push(message_of("abc"), Seconds(2));
  player.push(message_of("de"), Seconds(3));
  EXPECT_EQ(player.next(), Seconds(2) + Seconds(0.01));
  EXPECT_TRUE(player.take_due(Seconds(2.009)).empty());
  EXPECT_EQ(player.take_due(player.next()), protocol::Bytes{'a'});
  EXPECT_EQ(player.next(), Seconds(2) + Seconds(0.02));
  EXPECT_EQ(player.take_due(Seconds(3.015)), (protocol::Bytes{'b', 'c', 'd'}));
  EXPECT_TRUE(player.take_due(Seconds(3.015)).empty());
  EXPECT_EQ(player.take_due(Seconds(1e9)), protocol::Bytes{'e'});
}

}  // namespace
}  // namespace sim
