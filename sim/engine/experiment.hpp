#pragma once
// An experiment: all points of a scenario's sweep, one after the other, each by the engine.
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "sim/result/result.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

class ProcessGroup;

/// Where a run is, for whoever shows or keeps it.
struct Progress {
  const ExperimentResult& result;  // all so far, of the point at hand what an interrupt would leave
  std::size_t point;               // the one at hand, 0-based
  std::uint64_t max_frames;
};

struct ExperimentOptions {
  int threads = 1;
  bool profiled = false;
  ProcessGroup* processes = nullptr;  // each of whose members runs the same experiment
  const std::atomic<bool>* interrupt = nullptr;
  std::function<void(const Progress&)> on_progress{};
  /// After each finished point; the result holds all points so far.
  std::function<void(const ExperimentResult&, std::size_t point)> on_point{};
};

/// Whether a receiver of the sweep is one that theory knows.
bool has_theory(const LoadedScenario& scenario);

/// Throws Failure(bad_input) where a point of a link cannot be shared out like this.
void check_shard_of_frames(const LoadedScenario& scenario, const Shard& shard);
/// The same of another experiment.
void check_shard_of_runs(const LoadedScenario& scenario, const Shard& shard);

/// Operating points, flags and alarms of what is measured, as counts that were read back lack them.
void describe_points(const LoadedScenario& scenario, ExperimentResult& result);

/// Runs the one shard that `result` names, of all points that are not finished in it, each from
/// where it is; stops early, with the rest unfinished, when interrupted.
ExperimentResult run_experiment(const LoadedScenario& scenario, ExperimentResult result,
                                const ExperimentOptions& options);

}  // namespace sim
