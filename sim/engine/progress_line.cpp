#include "sim/engine/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

const std::string blank = "\r\033[K";  // the start of a terminal's line, emptied

bool on_terminal() { return isatty(STDERR_FILENO) == 1; }

/// Of the whole run, if each point takes as long as another.
double share_of(const RunStatus& status) {
  return (static_cast<double>(status.point) + status.share) / static_cast<double>(status.points);
}

std::string bar(double share) {
  constexpr int cells = 20;
  const auto full = static_cast<int>(share * cells);
  return fmt::format("[{:#<{}}{:-<{}}] {:.0f} %, ", "", full, "", cells - full, 100 * share);
}

std::string line_of(const RunStatus& status) {
  return fmt::format("point {} of {}: {}", status.point + 1, status.points, status.counted);
}

}  // namespace

RunStatus runs_status(RunStatus at, std::uint64_t done, std::uint64_t all, const std::string& unit,
                      const std::string& more) {
  at.share = static_cast<double>(done) / static_cast<double>(all);
  at.counted = fmt::format("{} of at most {} {}{}", done, all, unit, more);
  return at;
}

std::string time_left(double share, double elapsed_s) {
  constexpr double too_early_s = 2, too_little = 0.02;
  if (elapsed_s < too_early_s || share < too_little) return "";
  const double left_s = elapsed_s * (1 - share) / share;
  if (left_s < 90) return fmt::format(", about {:.0f} s left", left_s);
  if (left_s < 90 * 60) return fmt::format(", about {:.0f} min left", left_s / 60);
  return fmt::format(", about {:.0f} h left", left_s / 3600);
}

ProgressLine::ProgressLine(bool shown)
    : ProgressLine(shown, std::chrono::milliseconds(on_terminal() ? 200 : 30'000)) {}

ProgressLine::ProgressLine(bool shown, std::chrono::milliseconds pause)
    : shown_(shown),
      terminal_(on_terminal()),
      pause_(pause),
      due_(began_ + std::min(pause, std::chrono::milliseconds(800))) {}

bool ProgressLine::is_due() const { return shown_ && Clock::now() >= due_; }

void ProgressLine::show(const RunStatus& status) {
  if (!is_due()) return;
  const auto now = Clock::now();
  due_ = now + pause_;
  drawn_ = terminal_;
  const double share = share_of(status);
  const std::string line =
      line_of(status) + time_left(share, std::chrono::duration<double>(now - began_).count());
  draw(terminal_ ? blank + bar(share) + line : line + "\n");
}

void ProgressLine::clear() {
  if (drawn_) draw(blank);
  drawn_ = false;
}

}  // namespace sim
