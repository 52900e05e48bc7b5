#pragma once
// An experiment: all points of a scenario's sweep, one after the other, each by the engine.
#include <atomic>
#include <cstddef>
#include <functional>
#include <string>

#include "sim/result.hpp"
#include "sim/scenario.hpp"

namespace sim {

/// Where a run is, for whoever shows it.
struct Progress {
  std::size_t point, n_points;  // point: 0-based
  Tally tally;                  // of this point, so far
  double max_frames;
};

struct ExperimentOptions {
  int threads = 1;
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const Progress&)> on_progress{};
  /// After each finished point; the result holds all points so far.
  std::function<void(const ExperimentResult&, std::size_t point)> on_point{};
};

/// Runs all points; stops early, with the rest unfinished, when interrupted.
ExperimentResult run_experiment(const LoadedScenario& scenario, const std::string& command,
                                const ExperimentOptions& options);

}  // namespace sim
