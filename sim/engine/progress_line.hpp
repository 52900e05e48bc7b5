#pragma once
// The line on stderr that says how far a run is, from its first second on: rewritten in place on a
// terminal, behind a bar; a plain line each 30 s elsewhere.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace sim {

/// ", about 3 min left" of a run of which this share took so long; empty while nobody can know.
std::string time_left(double share, double elapsed_s);

/// Where a run is.
struct RunStatus {
  std::size_t point = 0, points = 1;  // the one at hand, 0-based, of so many
  double share = 0;                   // of that point
  std::string counted{};              // "120 of at most 200 runs"
};

/// With how many runs were done: "120 of at most 200 runs", and what more there is to say.
RunStatus runs_status(RunStatus at, std::uint64_t done, std::uint64_t all, const std::string& unit,
                      const std::string& more);

class ProgressLine {
 public:
  /// Shows nothing unless `shown`; with the usual pauses between lines, or `pause`.
  explicit ProgressLine(bool shown);
  ProgressLine(bool shown, std::chrono::milliseconds pause);

  void show(const RunStatus& status);
  /// Whether it would be shown now.
  bool is_due() const;
  /// Makes room for a line of results.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool shown_, terminal_;
  std::chrono::milliseconds pause_;
  bool drawn_ = false;
  Clock::time_point began_ = Clock::now(), due_;
};

}  // namespace sim
