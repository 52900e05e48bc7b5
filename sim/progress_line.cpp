#include "sim/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "sim/statistics.hpp"

namespace sim {
namespace {

std::string line_of(const Progress& p) {
  return fmt::format("point {} of {}: {} of at most {:.0f} frames, {} lost, BER {:.2g}",
                     p.point + 1, p.n_points, p.tally.n_frames, p.max_frames, p.tally.n_frames_lost,
                     p.tally.n_bits > 0 ? ratio(p.tally.n_bit_errors, p.tally.n_bits) : 0.0);
}

}  // namespace

ProgressLine::ProgressLine(bool shown) : shown_(shown), terminal_(isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(const Progress& progress) {
  if (!shown_) return;
  const auto now = Clock::now();
  const auto pause = terminal_ ? std::chrono::milliseconds(200) : std::chrono::milliseconds(3000);
  if (now - last_ < pause) return;
  last_ = now;
  drawn_ = terminal_;
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r\033[K" : "", line_of(progress),
             terminal_ ? "" : "\n");
  std::fflush(stderr);
}

void ProgressLine::clear() {
  if (drawn_) fmt::print(stderr, "\r\033[K");
  drawn_ = false;
}

}  // namespace sim
