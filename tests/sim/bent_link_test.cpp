// A link's checkpoint that was bent, by hand or by a fault: it is refused, not counted on.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "link_rule.hpp"
#include "scenarios.hpp"
#include "sim/engine/run_counting.hpp"

namespace sim {
namespace {

/// Checkpoints of 16 of 80 trials of a link, which are bent and then gone on with.
class BentLink : public testing::Test {
 protected:
  using Counting = RunCounting<LinkSetup, LinkTally, LinkPoint>;
  using Part = CountedRuns<LinkTally>;

  BentLink() {
    go_on(part_, make_link(scenario_.base), {.max_frames = 16}, {});
    part_.stop.reset();
  }

  /// Whether it is refused, when it is read or when the point is worked out.
  bool refuses(const std::function<void(Part&)>& bend) const {
    Part bent = part_;
    bend(bent);
    Counting counting(link_measurement, scenario_);
    try {
      counting.add(bytes_of(std::vector<std::vector<Part>>{{bent}}));
      counting.describe_all({});
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.code(), ExitCode::bad_input);
      return true;
    }
    return false;
  }

 private:
  const LoadedScenario scenario_ =
      loaded("stop.max_frames = 80\nsimulation.sample_rate_hz = 250000\n");
  Part part_;
};

TEST_F(BentLink, IsTakenAsItWas) {
  EXPECT_FALSE(refuses([](Part&) {}));
}

TEST_F(BentLink, IsRefusedWhereItsRunsAreNotThoseOfItsTally) {
  EXPECT_TRUE(refuses([](Part& p) { p.n = 8; }));
  EXPECT_TRUE(refuses([](Part& p) { p.n = 80; }));
  EXPECT_TRUE(refuses([](Part& p) { p.n = 88; }));
  EXPECT_TRUE(refuses([](Part& p) { p.n = 17; }));
  EXPECT_TRUE(refuses([](Part& p) { p.tally.sum.tally.n_frames = 0; }));
  EXPECT_TRUE(refuses([](Part& p) { p.shard = {1, 2}; }));
}

TEST_F(BentLink, IsRefusedWhereItCannotHaveEndedSo) {
  EXPECT_TRUE(refuses([](Part& p) { p.stop = StopReason::interrupted; }));
  EXPECT_TRUE(refuses([](Part& p) { p.stop = StopReason::max_frames; }));
  EXPECT_TRUE(refuses([](Part& p) { p = {.stop = StopReason::max_frame_errors}; }));
  EXPECT_FALSE(refuses([](Part& p) { p.stop = StopReason::max_frame_errors; }));
}

TEST_F(BentLink, IsRefusedWhereMoreFailedThanThereWas) {
  EXPECT_TRUE(refuses([](Part& p) { p.tally.sum.tally.n_frames_undetected = 17; }));
  EXPECT_TRUE(refuses([](Part& p) { p.tally.sum.tally.weighted.n_groups = 0.5; }));
  EXPECT_TRUE(refuses([](Part& p) { p.tally.sum.tally.weighted.bit_errors.sum = std::nan(""); }));
}

}  // namespace
}  // namespace sim
