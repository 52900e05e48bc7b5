#include "sim/engine/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

#include "sim/counting/statistics.hpp"
#include "sim/text/standard_output.hpp"

namespace sim {
namespace {

const std::string blank = "\r\033[K";  // the start of a terminal's line, emptied

bool on_terminal() { return isatty(STDERR_FILENO) == 1; }

/// Of the whole run, if each point takes as long as another.
double share_of(const Progress& p) {
  const double frames = static_cast<double>(p.result.points[p.point].tally.n_frames);
  return (static_cast<double>(p.point) + frames / static_cast<double>(p.max_frames)) /
         static_cast<double>(p.result.points.size());
}

std::string bar(double share) {
  constexpr int cells = 20;
  const auto full = static_cast<int>(share * cells);
  return fmt::format("[{:#<{}}{:-<{}}] {:.0f} %, ", "", full, "", cells - full, 100 * share);
}

std::string line_of(const Progress& p) {
  const Tally& tally = p.result.points[p.point].tally;
  const double ber = bit_error_ratio(tally, p.result.ci_level).value;
  return fmt::format("point {} of {}: {} of at most {} frames, {} lost{}, BER {}", p.point + 1,
                     p.result.points.size(), tally.n_frames, p.max_frames, tally.n_frames_lost,
                     tally.is_weighted() ? " as drawn" : "",
                     std::isnan(ber) ? "not yet known" : fmt::format("{:.2g}", ber));
}

}  // namespace

std::string time_left(double share, double elapsed_s) {
  constexpr double too_early_s = 2, too_little = 0.02;
  if (elapsed_s < too_early_s || share < too_little) return "";
  const double left_s = elapsed_s * (1 - share) / share;
  if (left_s < 90) return fmt::format(", about {:.0f} s left", left_s);
  if (left_s < 90 * 60) return fmt::format(", about {:.0f} min left", left_s / 60);
  return fmt::format(", about {:.0f} h left", left_s / 3600);
}

ProgressLine::ProgressLine(bool shown)
    : ProgressLine(shown, std::chrono::milliseconds(on_terminal() ? 200 : 3000)) {}

ProgressLine::ProgressLine(bool shown, std::chrono::milliseconds pause)
    : shown_(shown), terminal_(on_terminal()), pause_(pause) {}

void ProgressLine::show(const Progress& progress) {
  if (!shown_) return;
  const auto now = Clock::now();
  if (now - last_ < pause_) return;
  last_ = now;
  drawn_ = terminal_;
  const double share = share_of(progress);
  const std::string line =
      line_of(progress) + time_left(share, std::chrono::duration<double>(now - began_).count());
  draw(terminal_ ? blank + bar(share) + line : line + "\n");
}

void ProgressLine::clear() {
  if (drawn_) draw(blank);
  drawn_ = false;
}

}  // namespace sim
