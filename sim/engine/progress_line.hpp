#pragma once
// The line on stderr that says how far a run is: rewritten in place on a terminal, behind a bar; a
// plain line every few seconds elsewhere.
#include <chrono>
#include <string>

#include "sim/engine/experiment.hpp"

namespace sim {

/// ", about 3 min left" of a run of which this share took so long; empty while nobody can know.
std::string time_left(double share, double elapsed_s);

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
  Clock::time_point began_ = Clock::now(), last_ = began_;
};

}  // namespace sim
