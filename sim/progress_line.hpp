#pragma once
// The line on stderr that says how far a run is: rewritten in place on a terminal, a plain line
// every few seconds elsewhere.
#include <chrono>

#include "sim/experiment.hpp"

namespace sim {

class ProgressLine {
 public:
  explicit ProgressLine(bool shown);

  void show(const Progress& progress);
  /// Makes room for a line of results.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool shown_, terminal_;
  bool drawn_ = false;
  Clock::time_point last_ = Clock::now();
};

}  // namespace sim
