// Each cause of loss has a scene in which it is the one, and each scene a reason.
#include "arena_scenes.hpp"
#include "gtest/gtest.h"

namespace sim {
namespace {

const std::string two_minutes = "[arena]\nduration_s = 8\nruns = 16\n";
const std::string without_pause = "interval_min_ms = 0\ninterval_max_ms = 0\n";

double share(const SenderTally& tally, LossCause cause) {
  return static_cast<double>(tally[cause]) / static_cast<double>(tally.messages());
}

/// Of the first device.
SenderTally sender_tally(const std::string& scene, const std::vector<std::string>& set = {}) {
  return arena_point(two_minutes + scene, set).tally.senders.front();
}

// The receiver is switched on at time 0, be it in the middle of a message, whose end it then may
// take for a part of the next: of 16 first messages some are lost.
constexpr double first_messages = 0.03;

TEST(LossCauses, NearAndAloneAllIsDelivered) {
  const SenderTally tally = sender_tally(device("a", "1"));
  EXPECT_GT(tally.messages(), 100u);
  EXPECT_GT(share(tally, LossCause::delivered), 1 - first_messages);
  EXPECT_EQ(tally[LossCause::out_of_reach] + tally[LossCause::agc] + tally[LossCause::collision],
            0u);
  EXPECT_EQ(tally.n_in_reach, tally.messages());
  EXPECT_EQ(tally.n_overlapped, 0u);
}

TEST(LossCauses, ABusyDeviceIsSilent) {
  const SenderTally tally =
      sender_tally(device("a", "1", "silent_every_s = 1e-3\nsilent_for_s = 1e6"));
  EXPECT_EQ(share(tally, LossCause::silent), 1);
  EXPECT_EQ(tally.sent() + tally.airtime_us, 0u);
}

TEST(LossCauses, AFarDeviceIsOutOfReach) {
  const SenderTally tally = sender_tally(device("a", "100"));
  EXPECT_EQ(share(tally, LossCause::out_of_reach), 1);
  EXPECT_EQ(tally.n_in_reach + tally.airtime_in_reach_us, 0u);
  EXPECT_GT(tally.airtime_us, 0u);
}

// Noise lifts light that is a little less than the module hears: what it delivers was in reach.
TEST(LossCauses, WhatIsDeliveredFromBelowReachWasInReach) {
  const SenderTally tally = sender_tally(device("a", "12.4"));
  ASSERT_GT(tally[LossCause::out_of_reach], 0u);
  ASSERT_GT(tally[LossCause::delivered], 0u);
  EXPECT_EQ(tally.n_in_reach, tally.sent() - tally[LossCause::out_of_reach]);
  EXPECT_GE(tally.airtime_in_reach_us, tally.airtime_delivered_us);
}

// README: a TSOP4856 hears a device to 2.2 m, where its slow AGC ends the link; at 1 m it does not.
TEST(LossCauses, ASlowAgcKillsFromTwoMetresOn) {
  const std::string pauses = "interval_min_ms = 600\ninterval_max_ms = 1200";
  const std::vector<std::string> tsop{"receiver.module=TSOP4856"};
  const SenderTally near = sender_tally(device("a", "1", pauses), tsop);
  EXPECT_GT(share(near, LossCause::delivered), 1 - first_messages);
  EXPECT_EQ(near[LossCause::agc], 0u);
  const SenderTally far = sender_tally(device("a", "3", pauses), tsop);
  EXPECT_GT(share(far, LossCause::agc), 0.8);
  EXPECT_GT(share(far, LossCause::agc) + share(far, LossCause::delivered), 1 - first_messages);
}

TEST(LossCauses, TwoOfEqualLightCollide) {
  const SenderTally tally =
      sender_tally(device("a", "1", without_pause) +
                   device("b", "1", "carrier_error_ppm = 700\n" + without_pause));
  EXPECT_EQ(tally.n_overlapped, tally.messages());
  EXPECT_GT(share(tally, LossCause::collision), 0.95);
}

TEST(LossCauses, NobodyCollidesWithTheSilentNorWithTheFar) {
  const SenderTally tally = sender_tally(
      device("a", "1") + device("far", "100", without_pause) +
      device("quiet", "1", "silent_every_s = 1e-3\nsilent_for_s = 1e6\n" + without_pause));
  EXPECT_GT(tally.n_in_reach, 100u);
  EXPECT_EQ(tally.n_overlapped, 0u);
  EXPECT_EQ(tally[LossCause::collision], 0u);
}

// The comparator follows the stronger light, which the weaker, a hundredth of it, cannot reach.
TEST(LossCauses, TheStrongerCaptures) {
  const ArenaPoint point = arena_point(two_minutes + device("near", "0.5", without_pause) +
                                       device("weak", "9", without_pause));
  const SenderTally &near = point.tally.senders[0], &weak = point.tally.senders[1];
  EXPECT_GT(point.senders[0].highest_irradiance, 99 * point.senders[1].highest_irradiance);
  EXPECT_EQ(near.n_overlapped, near.messages());
  EXPECT_GT(static_cast<double>(near.n_captured), 0.95 * static_cast<double>(near.messages()));
  EXPECT_EQ(near.n_captured, near[LossCause::delivered]);
  EXPECT_GT(share(weak, LossCause::collision), 0.95);
}

// A clock that is 7 % slow puts the last bit of each character where its stop bit should be.
TEST(LossCauses, AWrongClockIsTheUartsLoss) {
  const SenderTally tally = sender_tally(device("a", "1", "clock_error_ppm = -70000"));
  EXPECT_EQ(share(tally, LossCause::uart), 1);
}

// At the edge of what noise allows single bits are wrong, seldom one that starts or ends a
// character.
TEST(LossCauses, ASingleWrongBitIsTheChecksumsLoss) {
  const SenderTally tally = sender_tally(device("a", "11"), {"noise.scale=8"});
  EXPECT_EQ(tally.n_in_reach, tally.messages());
  EXPECT_EQ(tally[LossCause::checksum] + tally[LossCause::uart] + tally[LossCause::delivered],
            tally.messages());
  EXPECT_GT(tally[LossCause::checksum], 2 * tally[LossCause::uart]);
  EXPECT_GT(share(tally, LossCause::checksum), 0.1);
}

}  // namespace
}  // namespace sim
