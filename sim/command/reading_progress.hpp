#pragma once
// On a terminal: how far a capture is read, once that takes long. Where messages go to the same
// terminal they say it themselves.
#include <unistd.h>

#include <chrono>
#include <string>
#include <utility>

#include "dsp/units.hpp"

namespace sim {

class ReadingProgress {
 public:
  /// `what` begins the line.
  ReadingProgress(std::string what, bool is_shown)
      : what_(std::move(what)), is_shown_(is_shown && ::isatty(STDERR_FILENO) == 1) {}

  ReadingProgress(const ReadingProgress&) = delete;
  ReadingProgress& operator=(const ReadingProgress&) = delete;
  ~ReadingProgress() { clear(); }

  void show(dsp::Seconds reached);
  /// Makes room for another line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  bool is_shown_, is_drawn_ = false;
  Clock::time_point last_ = Clock::now();
};

}  // namespace sim
