// Devices that send one short pulse of light for each zero bit: what modules are made for, and what
// their slow AGC leaves alone.
#include <gtest/gtest.h>

#include <cmath>

#include "arena_scenes.hpp"
#include "scenarios.hpp"
#include "sim/trace/trace.hpp"
#include "sim/trace/traced_message.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

/// A TSOP4856 in room light, 3 m away, behind two messages that settle its gain.
std::vector<std::string> far_link(const std::vector<std::string>& more = {}) {
  return with_keys({"receiver.range_m=3", "simulation.warmup_messages=2"}, more);
}

constexpr int trials = 8;

Tally pulsed_tally(const std::vector<std::string>& set) {
  return run_group(link_of(set), 0, trials, nullptr, false).tally;
}

// Bits of 1.7 ms are long bursts (Vishay 82459 rev 1.8 Fig. 8: from 80 cycles on): all is lost.
// 300 us are 18 cycles, and 158 us at 2400 Bd what Vishay recommends for its TSDP parts.
TEST(PulsedLink, CarriesWhereLightInWholeBitsDoesNot) {
  EXPECT_EQ(pulsed_tally(far_link()).n_frames_ok, 0U);
  for (const std::vector<std::string>& set :
       {far_link({"device.pulse_us=300"}), far_link({"device.pulse_us=158", "device.baud=2400"}),
        far_link({"device.pulse_us=300", "uart.receiver=mid-bit"}),
        far_link({"device.pulse_us=300", "simulation.fidelity=envelope"}),
        far_link({"device.pulse_us=300", "receiver.population=parts"})}) {
    const Tally tally = pulsed_tally(set);
    EXPECT_EQ(tally.n_frames_ok, std::uint64_t{trials}) << set.back();
    EXPECT_EQ(tally.n_bit_errors, 0U) << set.back();
    EXPECT_EQ(tally.n_byte_errors, 0U) << set.back();
  }
}

// A pulse of 158 us is over in the middle of a bit of 1.7 ms, where a UART looks.
TEST(PulsedLink, IsReadThroughAMonostable) {
  EXPECT_EQ(pulsed_tally(far_link({"device.pulse_us=158"})).n_frames_ok, std::uint64_t{trials});
  const Tally without = pulsed_tally(far_link({"device.pulse_us=158", "uart.monostable=false"}));
  EXPECT_EQ(without.n_frames_ok, 0U);
  EXPECT_GT(without.n_bit_errors, 0U);
}

TEST(PulsedLink, WholeBitsDoNotCareForAMonostable) {
  const Tally tally = pulsed_tally(clear_link({"uart.monostable=false"}));
  EXPECT_EQ(tally.n_frames_ok, std::uint64_t{trials});
  EXPECT_EQ(tally.n_bit_errors, 0U);
}

TEST(PulsedLink, ABitHasTheEnergyOfItsPulse) {
  const double whole = link_of(far_link()).operating.ebn0_db;
  const OperatingPoint pulsed = link_of(far_link({"device.pulse_us=158"})).operating;
  EXPECT_NEAR(pulsed.ebn0_db - whole, 10 * std::log10(158e-6 * 600), 1e-9);
  EXPECT_EQ(pulsed.snr_db, link_of(far_link()).operating.snr_db) << "while there is light";
  EXPECT_NEAR(link_of({"device.pulse_us=158", "receiver.ebn0_db=20"}).operating.ebn0_db, 20, 1e-6);
}

TEST(PulsedLink, IsTracedAsItWasSentAndRead) {
  const TracedTrial trial =
      trace_trial(point_scenario(loaded("", far_link({"device.pulse_us=158"})), {}), 0);
  const TracedMessage message = message_of(trial);
  ASSERT_EQ(message.sent.size(), 17U);
  ASSERT_EQ(message.received.size(), 3 * 17U) << "those before it, too";
  for (std::size_t i = 0; i < message.sent.size(); ++i) {
    EXPECT_TRUE(message.is_as_sent(message.received[2 * 17 + i])) << i;
    for (int slot = 0; slot < protocol::bits_per_byte; ++slot)
      EXPECT_FALSE(is_wrong_at_pin(trial, message, i, slot)) << i << " " << slot;
  }
  const auto edges = trial.tx.edges();
  EXPECT_NEAR((edges[1] - edges[0]).value, 158e-6, 1e-9) << "the LED's wire has the pulses";
}

TEST(PulsedLink, RefusesWhatIsNoPulse) {
  EXPECT_EQ(refusal("", {"device.pulse_us=60"}),
            "device.pulse_us = 60 in --set (a pulse is of 4 carrier periods at least, and within "
            "its bit) use 67.8 to 1.67e+03, or 0 for light in the whole bit");
  EXPECT_NE(refusal("", {"device.pulse_us=1700"}), "accepted");
  EXPECT_EQ(refusal("", {"device.pulse_us=158", "receiver.module=ideal-coherent"}),
            "device.pulse_us = 158 in --set with receiver.module = \"ideal-coherent\" (a matched "
            "receiver takes the light of whole bits) remove one of the two");
  EXPECT_NE(refusal("", {"device.pulse_us=158", "simulation.method=importance"})
                .find("weights are of bits that are light as a whole"),
            std::string::npos);
}

// The same in an arena, where a TSOP4856 hears nothing of whole bits 3 m away.
TEST(PulsedLink, CarriesInArenas) {
  const std::string text = device("charger", "3") + "[arena]\nduration_s = 10\n";
  const auto ok = [&](const std::vector<std::string>& set) {
    return arena_point(text, with_keys({"receiver.module=TSOP4856"}, set))
        .tally.senders.front()[LossCause::delivered];
  };
  EXPECT_LT(ok({}), 3U);
  EXPECT_GT(ok({"device.pulse_us=300"}), 8U);
}

}  // namespace
}  // namespace sim
