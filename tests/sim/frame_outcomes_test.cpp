#include "sim/check/frame_outcomes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "protocol/uart_receivers.hpp"
#include "scenarios.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/trial/trial.hpp"

namespace sim {
namespace {

constexpr std::uint32_t first = 40;
constexpr int frames = 64;

std::vector<const protocol::UartReceiver*> all_receivers() {
  std::vector<const protocol::UartReceiver*> all;
  for (const protocol::UartReceiver& receiver : protocol::uart_receivers())
    all.push_back(&receiver);
  return all;
}

std::uint64_t count_of(FrameOutcome outcome, const std::vector<FrameOutcome>& outcomes) {
  return static_cast<std::uint64_t>(std::ranges::count(outcomes, outcome));
}

/// Frames of the same link are lost as a run counts them; says how many.
std::uint64_t check_against_runs(const std::string& text) {
  Link link = make_link(point_scenario(loaded(text), {}));
  const auto receivers = all_receivers();
  const auto outcomes = frame_outcomes(link, receivers, first, frames);
  EXPECT_EQ(outcomes.size(), receivers.size());
  std::uint64_t lost = 0;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    link.uart = receivers[i];
    Tally run;
    for (const GroupResult& group : run_groups(link, first, frames)) run += group.tally;
    EXPECT_EQ(count_of(FrameOutcome::delivered, outcomes[i]), run.n_frames_ok);
    EXPECT_EQ(outcomes[i].size(), run.n_frames);
    lost += run.n_frames_lost;
  }
  return lost;
}

TEST(FrameOutcomes, AreThoseOfRunsWithEachReceiver) {
  EXPECT_GT(check_against_runs("[receiver]\nrange_m = 2.17\n"), 0U);
  EXPECT_GT(check_against_runs("[receiver]\nrange_m = 2.17\n[simulation]\nfidelity = 'envelope'\n"),
            0U);
  EXPECT_GT(check_against_runs("[receiver]\nmodule = 'ideal-coherent'\nebn0_db = 9\n"
                               "[simulation]\nfidelity = 'decision'\n"),
            0U);
}

TEST(FrameOutcomes, OfOneReceiverDoNotHangOnTheOthersOrOnWhatRunsTogether) {
  const Link link = link_of({"receiver.range_m=2.17"});
  const auto* atmega = protocol::find_uart_receiver("atmega");
  const auto together = frame_outcomes(link, all_receivers(), first, frames);
  EXPECT_EQ(frame_outcomes(link, {atmega, atmega}, first, frames)[1], together[0]);
  for (std::uint32_t i = 0; i < 5; ++i)
    EXPECT_EQ(frame_outcomes(link, {atmega}, first + i, 1)[0][0], together[0][i]);
}

}  // namespace
}  // namespace sim
