#pragma once
// The line on stderr that says how far a run is: rewritten in place on a terminal, a plain line
// every few seconds elsewhere.
#include <chrono>

#include "sim/engine/experiment.hpp"

namespace sim {

class ProgressLine {
 public:
  /// Shows nothing unless `shown`; with the usual pauses between lines, or `pause`.
  explicit ProgressLine(bool shown);
  ProgressLine(bool shown, std::chrono::milliseconds pause);

  void show(const Progress& progress);
  /// Makes room for a line of results.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool shown_, terminal_;
  std::chrono::milliseconds pause_;
  bool drawn_ = false;
  Clock::time_point last_ = Clock::now();
};

}  // namespace sim
