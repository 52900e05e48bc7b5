#include "sim/command/reading_progress.hpp"

#include <fmt/format.h>

#include "sim/text/standard_output.hpp"

namespace sim {

void ReadingProgress::show(dsp::Seconds reached) {
  constexpr auto pause = std::chrono::milliseconds(500);
  const auto now = Clock::now();
  if (!is_shown_ || now - last_ < pause) return;
  last_ = now;
  is_drawn_ = true;
  draw("\r\033[K");
  say(fmt::format("{}, at {:.3f} s of it", what_, reached.value));
}

void ReadingProgress::clear() {
  if (is_drawn_) draw("\r\033[K");
  is_drawn_ = false;
}

}  // namespace sim
