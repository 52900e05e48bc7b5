// What is said while a run goes on, and that nobody needs to hear it.
#include "sim/engine/progress_line.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "sim/link_experiment/link_report.hpp"

namespace sim {
namespace {

/// A point of which 16 frames were sent.
LinkPoint sixteen_frames() {
  LinkPoint point;
  point.tally.n_frames = 16;
  point.tally.n_frames_lost = 3;
  point.tally.n_bits = 1000;
  point.tally.n_bit_errors = 20;
  return point;
}

void show_at_once(bool shown, const LinkPoint& point = sixteen_frames()) {
  ProgressLine line(shown, std::chrono::milliseconds(0));
  line.show(runs_status({.point = 1, .points = 2}, 16, 4000000000u, "frames",
                        link_report.progress(point)));
  line.clear();
}

TEST(ProgressLine, SaysHowFarARunIs) {
  testing::internal::CaptureStderr();
  show_at_once(true);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "point 2 of 2: 16 of at most 4000000000 frames, 3 lost, BER 0.02\n");
}

TEST(ProgressLine, SaysHowLongItWillTakeOnceThatCanBeKnown) {
  EXPECT_EQ(time_left(0.5, 1), "");
  EXPECT_EQ(time_left(0.01, 100), "");
  EXPECT_EQ(time_left(0.25, 10), ", about 30 s left");
  EXPECT_EQ(time_left(0.5, 120), ", about 2 min left");
  EXPECT_EQ(time_left(0.1, 3600), ", about 9 h left");
  EXPECT_EQ(time_left(1, 3600), ", about 0 s left");
}

// Of frames that are drawn to fail the counts say nothing, their weights do.
TEST(ProgressLine, SaysOfWeightedFramesWhatTheyAreWorth) {
  LinkPoint drawn = sixteen_frames();
  drawn.tally.weighted.n_groups = 2;
  testing::internal::CaptureStderr();
  show_at_once(true, drawn);
  drawn.tally.weighted.bit_errors = weighted_sum(std::vector<double>(30, 1e-9));
  show_at_once(true, drawn);
  const std::string frames = "point 2 of 2: 16 of at most 4000000000 frames, 3 lost as drawn, BER ";
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            frames + "not yet known\n" + frames + "3e-11\n");
}

TEST(ProgressLine, SaysOfManyPointsHowManyCarrySoFar) {
  LinkPoint none = sixteen_frames(), few = sixteen_frames();
  none.tally.n_frames_lost = 0;
  few.tally.n_frames_lost = 1;
  EXPECT_EQ(link_report.so_far({none, few, none}, 2), "1 of 2 lose at most 1 % of frames");
}

// One line in the first second, and then none for half a minute, if nobody sits at a terminal.
TEST(ProgressLine, IsDueInItsFirstSecond) {
  const int before = ::dup(STDERR_FILENO), null = ::open("/dev/null", O_WRONLY);
  ::dup2(null, STDERR_FILENO);
  ProgressLine line(true);
  EXPECT_FALSE(line.is_due());
  ::usleep(850'000);
  EXPECT_TRUE(line.is_due());
  line.show({});
  EXPECT_FALSE(line.is_due());
  ::dup2(before, STDERR_FILENO);
  ::close(before);
  ::close(null);
}

TEST(ProgressLine, IsSilentWhenAskedToBe) {
  testing::internal::CaptureStderr();
  show_at_once(false);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ProgressLine, AFullDiskIsNoReasonToEnd) {
  const int before = ::dup(STDERR_FILENO);
  const int full = ::open("/dev/full", O_WRONLY);
  ::dup2(full, STDERR_FILENO);
  EXPECT_NO_THROW(show_at_once(true));
  ::dup2(before, STDERR_FILENO);
  ::close(before);
  ::close(full);
}

}  // namespace
}  // namespace sim
