// One trial: what is counted, and that it counts the right thing.
#include "sim/trial/trial.hpp"

#include <random>
#include <string>

#include "gtest/gtest.h"
#include "scenarios.hpp"
#include "sim/trace/trace_file.hpp"

namespace sim {
namespace {

/// The wire of the LED as the module's pin would be: the same, late by the constant delay.
dsp::LogicTrace delayed(const dsp::LogicTrace& line, dsp::Seconds delay) {
  dsp::LogicTrace pin(true);
  for (const dsp::Seconds edge : line.edges()) pin.add_edge(edge + delay);
  pin.observe_until(line.end() + delay);
  return pin;
}

/// The pin that would be heard if the bytes of the last message were `bytes`.
dsp::LogicTrace pin_saying(const Link& link, const Transmission& sent,
                           const protocol::Bytes& bytes) {
  dsp::LogicTrace pin(true);
  for (std::size_t m = 0; m < sent.messages.size(); ++m) {
    const bool last = m + 1 == sent.messages.size();
    for (std::size_t i = 0; i < link.bytes.size(); ++i)
      protocol::send_byte(pin, (last ? bytes : link.bytes)[i],
                          sent.messages[m].byte_start[i] + link.delay, link.device_baud);
  }
  pin.observe_until(sent.line.end() + dsp::Seconds(0.1));
  return pin;
}

Tally tally_of_pin(const Link& link, const Transmission& sent, dsp::LogicTrace pin) {
  return count(link, sent, receive(link, 0, std::move(pin)));
}

TEST(Trial, IdentityHasNoErrors) {
  for (const char* uart : {"atmega", "mid-bit"}) {
    const Link link = link_of({std::string("uart.receiver=") + uart, "device.start_jitter_us=300"});
    for (std::uint32_t trial = 0; trial < 50; ++trial) {
      const Transmission sent = transmit(link, trial);
      const Tally tally = tally_of_pin(link, sent, delayed(sent.line, link.delay));
      EXPECT_EQ(tally.n_bits, 170u);
      EXPECT_EQ(tally.n_bit_errors, 0u);
      EXPECT_EQ(tally.n_byte_errors + tally.n_framing_errors, 0u);
      EXPECT_EQ(tally.n_frames_ok, 1u);
      EXPECT_EQ(tally.n_frames_lost + tally.n_frames_false + tally.n_frames_undetected, 0u);
    }
  }
}

// U3: 106 of the 170 line bits of `IND 011111 OK 46\n` are light (on-fraction .6235).
TEST(Trial, DeadPinGetsEveryLightBitWrong) {
  const Link link = link_of({});
  const Transmission sent = transmit(link, 0);
  dsp::LogicTrace pin(true, sent.line.end());
  const Tally tally = tally_of_pin(link, sent, pin);
  EXPECT_EQ(tally.n_bit_errors, 106u);
  EXPECT_EQ(tally.sum_bit_errors_squared, 106u * 106u);
  EXPECT_EQ(tally.n_byte_errors, 17u);
  EXPECT_EQ(tally.n_frames_lost, 1u);
  EXPECT_EQ(tally.n_frames_ok, 0u);
  EXPECT_EQ(tally.n_frames_unheard, 1u);
  EXPECT_EQ(tally.n_frames_unended, 0u);
}

/// A trial in which bit 0 of these bytes of the message arrives wrong.
Tally tally_of_wrong_bits(std::uint32_t trial, std::initializer_list<std::size_t> at) {
  const Link link = link_of({});
  const Transmission sent = transmit(link, trial);
  protocol::Bytes bytes = link.bytes;
  for (const std::size_t i : at) bytes[i] ^= 1;
  return tally_of_pin(link, sent, pin_saying(link, sent, bytes));
}

TEST(Trial, WrongBitIsRejectedByTheChecksum) {
  const Tally tally = tally_of_wrong_bits(1, {5});
  EXPECT_EQ(tally.n_bit_errors, 1u);
  EXPECT_EQ(tally.n_byte_errors, 1u);
  EXPECT_EQ(tally.n_rejected_checksum, 1u);
  EXPECT_EQ(tally.n_frames_lost, 1u);
  EXPECT_EQ(tally.n_frames_undetected, 0u);
}

// The weakness of XOR: two errors in one bit column of two characters cancel.
TEST(Trial, TwoErrorsInAColumnAreUndetected) {
  const Tally tally = tally_of_wrong_bits(2, {5, 6});
  EXPECT_EQ(tally.n_bit_errors, 2u);
  EXPECT_EQ(tally.n_frames_undetected, 1u);
  EXPECT_EQ(tally.n_frames_lost, 1u);
  EXPECT_EQ(tally.n_frames_ok, 0u);
}

TEST(Trial, EveryReasonIsCounted) {
  const Link link = link_of({});
  const Transmission sent = transmit(link, 3);
  const auto with = [&](std::size_t at, std::uint8_t value) {
    protocol::Bytes bytes = link.bytes;
    bytes[at] = value;
    return tally_of_pin(link, sent, pin_saying(link, sent, bytes));
  };
  EXPECT_EQ(with(4, 0x07).n_rejected_unprintable, 1u);
  EXPECT_EQ(with(14, 'x').n_rejected_not_hex, 1u);
  EXPECT_EQ(with(14, '5').n_rejected_checksum, 1u);
  EXPECT_EQ(with(14, ' ').n_rejected_short, 1u);
}

// The longest message fills its line: without the newline, there is no room left for one.
TEST(Trial, LongestMessageWithoutItsNewlineIsRejectedAsOverlong) {
  const Link link = link_of({"device.message=" + std::string(protocol::longest_message, 'x')});
  const Transmission sent = transmit(link, 3);
  protocol::Bytes bytes = link.bytes;
  EXPECT_EQ(tally_of_pin(link, sent, pin_saying(link, sent, bytes)).n_frames_ok, 1u);
  bytes.back() ^= 1;
  const Tally tally = tally_of_pin(link, sent, pin_saying(link, sent, bytes));
  EXPECT_EQ(tally.n_rejected_overlong, 1u);
  EXPECT_EQ(tally.n_frames_lost, 1u);
  EXPECT_EQ(tally.n_frames_unended, 0u);
}

// A damaged newline merges the message with whatever comes next: nothing is rejected, all is lost.
TEST(Trial, MessageWhoseNewlineIsDamagedIsCountedAsUnended) {
  const Link link = link_of({});
  const Transmission sent = transmit(link, 3);
  protocol::Bytes bytes = link.bytes;
  bytes.back() ^= 1;
  const Tally tally = tally_of_pin(link, sent, pin_saying(link, sent, bytes));
  EXPECT_EQ(tally.n_frames_lost, 1u);
  EXPECT_EQ(tally.n_frames_unended, 1u);
  EXPECT_EQ(tally.n_frames_unheard, 0u);
}

// Every lost frame has a reason: what was rejected, what was accepted wrongly, or one of the two.
TEST(Trial, EveryLossHasAReason) {
  for (const char* range : {"2.2", "2.5", "5", "10", "40"}) {
    const Link link = link_of({std::string("receiver.range_m=") + range});
    for (std::uint32_t trial = 0; trial < 32; trial += 8) {
      const Tally t = run_group(link, trial, 8).tally;
      const auto rejected = t.n_rejected_unprintable + t.n_rejected_short + t.n_rejected_not_hex +
                            t.n_rejected_checksum + t.n_rejected_overlong;
      EXPECT_LE(t.n_frames_unheard + t.n_frames_unended, t.n_frames_lost) << range;
      EXPECT_GE(t.n_frames_unheard + t.n_frames_unended + t.n_frames_undetected + rejected,
                t.n_frames_lost)
          << range;
    }
  }
}

// One lost start bit does not make all the bytes behind it wrong: bytes are matched by time.
TEST(Trial, BytesAreMatchedByTime) {
  const Link link = link_of({});
  const Transmission sent = transmit(link, 4);
  dsp::LogicTrace pin(true);
  for (std::size_t i = 0; i < link.bytes.size(); ++i) {
    if (i == 3) continue;  // never heard
    protocol::send_byte(pin, link.bytes[i], sent.messages.back().byte_start[i] + link.delay,
                        link.device_baud);
  }
  pin.observe_until(sent.line.end());
  EXPECT_EQ(tally_of_pin(link, sent, pin).n_byte_errors, 1u);
}

// A frame in the dark between messages was not sent by anybody; warm-up messages were.
TEST(Trial, FramesThatNobodySentAreFalse) {
  const Link link = link_of({"device.interval_min_ms=900", "simulation.warmup_messages=1"});
  const Transmission sent = transmit(link, 5);
  const dsp::Seconds gap = sent.messages[0].end + dsp::Seconds(0.2);
  dsp::LogicTrace pin(true);
  for (const auto& [message, start] : {std::pair{0, sent.messages[0].byte_start[0]},
                                       {-1, gap},
                                       {1, sent.messages[1].byte_start[0]}}) {
    dsp::Seconds t = start + link.delay;
    for (const auto byte : link.bytes) t = protocol::send_byte(pin, byte, t, link.device_baud);
  }
  pin.observe_until(sent.line.end());
  const Tally tally = tally_of_pin(link, sent, pin);
  EXPECT_EQ(tally.n_frames_false, 1u);
  EXPECT_EQ(tally.n_frames_ok, 1u);
}

TEST(Trial, ClearLightLinkDeliversEverything) {
  std::mt19937 random(9);
  for (int round = 0; round < 6; ++round) {
    std::string message = "device.message=";
    for (int i = 0; i < 5 + round * 5; ++i) message += static_cast<char>(0x21 + random() % 0x5E);
    const Link link = link_of(clear_link({message}));
    const Tally tally = run_group(link, 0, 8).tally;
    EXPECT_EQ(tally.n_bit_errors, 0u) << message;
    EXPECT_EQ(tally.n_frames_ok, 8u) << message;
    EXPECT_EQ(tally.n_byte_errors + tally.n_framing_errors, 0u) << message;
  }
}

TEST(Trial, DarkLinkDeliversNothing) {
  const Link link = link_of({"receiver.range_m=900"});
  const Tally tally = run_group(link, 0, 8).tally;
  EXPECT_EQ(tally.n_frames_lost, 8u);
  EXPECT_EQ(tally.n_bit_errors, 8u * 106u);
  EXPECT_EQ(tally.n_frames_false, 0u);
}

// Intervals run from the end of one message to the start of the next, uniform in their bounds.
TEST(Trial, IntervalsAreInTheirBounds) {
  const Link link = link_of({"simulation.warmup_messages=4"});
  double least = 1, most = 0;
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    const Transmission sent = transmit(link, trial);
    ASSERT_EQ(sent.messages.size(), 5u);
    for (std::size_t i = 1; i < 5; ++i) {
      const double gap = (sent.messages[i].byte_start[0] - sent.messages[i - 1].end).value;
      least = std::min(least, gap);
      most = std::max(most, gap);
    }
  }
  EXPECT_GE(least, 0.1);
  EXPECT_LT(least, 0.11);
  EXPECT_LE(most, 0.9);
  EXPECT_GT(most, 0.89);
}

// Adding a cause of randomness leaves the draws of the others as they were.
TEST(Trial, JitterLeavesTheNoiseAlone) {
  const Link with = link_of({"device.start_jitter_us=100"}), without = link_of({});
  Link same_point = with;
  same_point.point = without.point;
  const Transmission sent = transmit(without, 7);
  EXPECT_EQ(chain_input(same_point, 7, sent).noise_seed, chain_input(without, 7, sent).noise_seed);
}

TEST(TrialDeterminism, TheTrialThatIsTracedIsTheTrialThatWasCounted) {
  const std::vector<std::string> set = {"receiver.range_m=3", "ambient.irradiance_w_per_m2=20",
                                        "simulation.warmup_messages=1"};
  const Scenario scenario = point_scenario(loaded("", set), {});
  const Link link = make_link(scenario);
  Tally one_by_one;
  for (std::uint32_t trial = 4711; trial < 4719; ++trial) {
    const TracedTrial traced = trace_trial(scenario, trial);
    one_by_one += count(link, transmit(link, trial), receive(link, trial, traced.rx));
  }
  EXPECT_EQ(one_by_one, run_group(link, 4711, 8).tally);
  EXPECT_GT(one_by_one.n_bit_errors, 0u) << "the test needs a link that fails now and then";
}

}  // namespace
}  // namespace sim
