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

std::string line_of(const Progress& p) {
  const Tally& tally = p.result.points[p.point].tally;
  const double ber = bit_error_ratio(tally, p.result.ci_level).value;
  return fmt::format("point {} of {}: {} of at most {} frames, {} lost{}, BER {}", p.point + 1,
                     p.result.points.size(), tally.n_frames, p.max_frames, tally.n_frames_lost,
                     tally.is_weighted() ? " as drawn" : "",
                     std::isnan(ber) ? "not yet known" : fmt::format("{:.2g}", ber));
}

}  // namespace

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
  say(terminal_ ? blank + line_of(progress) : line_of(progress) + "\n");
}

void ProgressLine::clear() {
  if (drawn_) say(blank);
  drawn_ = false;
}

}  // namespace sim
