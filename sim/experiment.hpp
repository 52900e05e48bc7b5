#pragma once
// An experiment: all points of a scenario's sweep, one after the other, each by the engine.
#include <atomic>
#include <cstddef>
#include <functional>
#include <string>

#include "sim/result.hpp"
#include "sim/scenario.hpp"

namespace sim {

/// Where a run is, for whoever shows or keeps it.
struct Progress {
  const ExperimentResult& result;  // all so far, of the point at hand what an interrupt would leave
  std::size_t point;               // the one at hand, 0-based
  double max_frames;
};

struct ExperimentOptions {
  int threads = 1;
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const Progress&)> on_progress{};
  /// After each finished point; the result holds all points so far.
  std::function<void(const ExperimentResult&, std::size_t point)> on_point{};
};

/// The experiment before its first trial: axes, and points with nothing counted.
ExperimentResult unfinished(const LoadedScenario& scenario, const std::string& command);

/// Runs all points that are not finished in `result`, each from where it is; stops early, with the
/// rest unfinished, when interrupted.
ExperimentResult run_experiment(const LoadedScenario& scenario, ExperimentResult result,
                                const ExperimentOptions& options);

}  // namespace sim
