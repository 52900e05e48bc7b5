// What a robot has heard on its way to the base station: nothing is counted twice or forgotten, and
// how old the base station's knowledge is follows from when things were said.
#include <cmath>
#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "sim/guard/relay.hpp"

namespace {

using sim::GuardTally;
using sim::HeardFrame;
using sim::RelayDesign;

constexpr double frame_s = 0.2;

HeardFrame heard(std::uint32_t variable, double start_s, const std::string& message) {
  return {.sender = variable, .start_s = start_s, .end_s = start_s + frame_s, .message = message};
}

RelayDesign design(std::vector<std::string> variables = {"A", "B"}) {
  RelayDesign d{
      .variables = std::move(variables), .settings = {}, .duration = dsp::Seconds(60), .delay = {}};
  d.settings.line_baud = 115200;
  return d;
}

GuardTally run(const RelayDesign& d, const std::vector<HeardFrame>& frames,
               std::uint32_t trial = 0) {
  return sim::relay(d, frames, {.seed = 1, .point = 2, .trial = trial, .purpose = 13});
}

/// Two devices that take turns; every message is another.
std::vector<HeardFrame> conversation(double every_s) {
  std::vector<HeardFrame> frames;
  for (int i = 0; i * every_s < 59; ++i)
    frames.push_back(
        heard(static_cast<std::uint32_t>(i % 2), i * every_s, "X " + std::to_string(i)));
  return frames;
}

std::uint64_t known(const GuardTally& tally) {
  return tally.relays[0].n_known + tally.relays[1].n_known;
}
std::uint64_t lost(const GuardTally& tally) {
  return tally.relays[0].n_lost + tally.relays[1].n_lost;
}
std::uint64_t replaced(const GuardTally& tally) {
  return tally.relays[0].n_replaced + tally.relays[1].n_replaced;
}

TEST(GuardRelay, OnAWholeLineEverythingBecomesKnown) {
  const auto frames = conversation(1);
  for (const double compressed : {0.0, 1.0}) {
    RelayDesign d = design();
    d.settings.compressed = compressed;
    const GuardTally tally = run(d, frames);
    EXPECT_EQ(known(tally), frames.size());
    EXPECT_EQ(lost(tally) + replaced(tally), 0U);
  }
}

TEST(GuardRelay, EveryMessageHeardIsKnownLostOrReplaced) {
  RelayDesign d = design();
  d.settings.byte_error_ratio = 0.01;
  d.settings.outage_every_s = 5;
  d.settings.outage_for_s = 3;
  d.settings.transmit_every_ms = 800;
  const auto frames = conversation(0.3);
  for (std::uint32_t trial = 0; trial < 20; ++trial) {
    const GuardTally tally = run(d, frames, trial);
    EXPECT_EQ(known(tally) + lost(tally) + replaced(tally), frames.size());
    EXPECT_GT(known(tally), 0U);
    EXPECT_GT(lost(tally), 0U);
    EXPECT_GT(replaced(tally), 0U) << "two of a device within one turn of the robot's";
    EXPECT_GE(tally.n_sent, tally.n_accepted);
  }
}

TEST(GuardRelay, WithoutALineNothingIsKnown) {
  RelayDesign d = design();
  d.settings.outage_every_s = 1e-6;
  d.settings.outage_for_s = 1e6;
  const auto frames = conversation(1);
  const GuardTally tally = run(d, frames);
  EXPECT_EQ(known(tally), 0U);
  EXPECT_EQ(lost(tally), frames.size()) << "each is carried in a full set, and lost";
  EXPECT_EQ(tally.relays[0].age.unknown_share(), 1);
  EXPECT_TRUE(std::isnan(tally.relays[0].age.mean_s()));
  EXPECT_EQ(tally.n_answered, 0U);
  EXPECT_GT(tally.n_timed_out, 0U);
}

TEST(GuardRelay, KnowledgeAgesFromWhenTheDeviceBeganToSpeak) {
  const GuardTally tally = run(design(), {heard(0, 10, "X 1")});
  const auto& age = tally.relays[0].age;
  // Looked at every 0.2 s: unknown up to its end and the robot's next turn, then from about 0.4 s
  // to 50 s old.
  EXPECT_NEAR(age.unknown_share(), 10.3 / 60, 0.5 / 60);
  EXPECT_NEAR(age.mean_s(), (0.4 + 49.8) / 2, 0.2);
  EXPECT_NEAR(age.quantile_s(0.95), 0.4 + 0.95 * 49.4, 0.3);
  EXPECT_EQ(tally.relays[1].age.unknown_share(), 1);
}

TEST(GuardRelay, AnUnchangedStatusIsRenewedByFullSetsAlone) {
  std::vector<HeardFrame> frames;
  for (int i = 0; i < 59; ++i) frames.push_back(heard(0, i, "X same"));
  RelayDesign d = design();
  d.settings.full_set_every_s = 10;
  const GuardTally compressed = run(d, frames);
  d.settings.compressed = 0;
  const GuardTally whole = run(d, frames);
  EXPECT_LT(whole.relays[0].age.mean_s(), 1.2);
  EXPECT_GT(compressed.relays[0].age.mean_s(), 3) << "the base knows it from the last full set";
  EXPECT_EQ(whole.relays[0].n_known, frames.size());
  EXPECT_LT(compressed.relays[0].n_known, frames.size() / 3);
  EXPECT_EQ(compressed.relays[0].n_lost, 0U);
}

TEST(GuardRelay, TheBaseAsksForWhatIsOldAndIsAnswered) {
  RelayDesign d = design();
  d.settings.full_set_every_s = 1000;
  d.settings.query_age_s = 5;
  const GuardTally tally = run(d, {heard(0, 1, "X 1")});
  // A is there from about 1 s on, is asked for every 5 s and answered; B never, and is asked for
  // every second.
  EXPECT_NEAR(static_cast<double>(tally.n_answered), 10, 2);
  EXPECT_NEAR(static_cast<double>(tally.n_timed_out), 59, 2) << "none behind the run";
}

TEST(GuardRelay, ALineSlowerThanItsMessagesLeavesTurnsOut) {
  RelayDesign d = design();
  d.settings.line_baud = 50;  // a full set takes seconds
  const auto frames = conversation(1);
  const GuardTally tally = run(d, frames);
  EXPECT_EQ(known(tally) + lost(tally) + replaced(tally), frames.size());
  EXPECT_GT(replaced(tally), frames.size() / 2);
  EXPECT_GT(known(tally), 5U);
}

TEST(GuardRelay, WhatIsOnASlowLineWhenTheRunEndsIsNotReplaced) {
  RelayDesign d = design();
  d.duration = dsp::Seconds(5);
  d.settings.line_baud = 50;  // 15 s for this message
  const GuardTally tally = run(d, {heard(0, 1, "X " + std::string(60, 'y'))});
  EXPECT_EQ(tally.relays[0].n_known, 1U);
}

TEST(AgeCounts, MeanAndQuantileOfAges) {
  sim::AgeCounts ages, more;
  for (int i = 0; i < 50; ++i) ages.add(0.05 + 0.1 * i);
  for (int i = 50; i < 100; ++i) more.add(0.05 + 0.1 * i);
  more.add_unknown();
  ages += more;
  EXPECT_NEAR(ages.mean_s(), 5, 1e-9);
  EXPECT_NEAR(ages.quantile_s(0.95), 9.5, 1e-9);
  EXPECT_NEAR(ages.quantile_s(1), 10, 1e-9);
  EXPECT_EQ(ages.known(), 100U);
  EXPECT_NEAR(ages.unknown_share(), 1 / 101.0, 1e-12);
}

}  // namespace
