#pragma once
// What a run will take, told from a few runs of each point before any of them is counted.
#include <cstdint>
#include <vector>

#include "sim/counting/statistics.hpp"
#include "sim/counting/stop_rule.hpp"

namespace sim {

/// A few runs of a point.
struct RunPilot {
  std::vector<double> coordinates;
  std::uint64_t runs = 0;   // that the point shall have at most
  StopRule rule{};          // of the run to come
  std::uint32_t group = 1;  // runs that are counted together
  std::uint32_t threads = 1;
  double setup_s = 0;  // to work the point out
  double run_s = 0;    // wall-clock time over runs, where all threads have some to do
  // What so many runs gave:
  std::uint32_t counted = 0;
  Estimate ratio{};   // of rule.rel_ci, at 95 %
  Estimate loss{};    // of rule.target_flr, at sure_level
  double losses = 0;  // of rule.max_frame_errors
};

/// Whether the rule may need fewer than all runs.
bool may_stop_early(const RunPilot& pilot);

/// About how many runs the point will have when its rule ends it. A rule whose losses no run of the
/// pilot showed is not expected to end it: then the limit remains.
double expected_runs(const RunPilot& pilot);

/// Wall-clock time of a point; of all.
double expected_seconds(const RunPilot& pilot);
double expected_seconds(const std::vector<RunPilot>& pilots);

/// The largest limit of runs a point, in whole groups, from one group to `most`, with which all
/// points together are expected to end within a time.
std::uint64_t runs_within(const std::vector<RunPilot>& pilots, double seconds, double most);

}  // namespace sim
