#pragma once
// What an experiment tells the engine, which counts its runs (sim/engine/run_counting).
#include <atomic>
#include <cstdint>
#include <vector>

#include "sim/counting/statistics.hpp"
#include "sim/engine/run_span.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

/// How an experiment is measured. Setup: a point with all worked out that its runs share. Tally:
/// what runs count: an empty one has no runs; += adds the runs that follow; serialize is cereal's;
/// where it has elapsed_s, that is the wall clock of its runs. Point: what is known of a point; has
/// reached(), whether it has runs, and `stop`, why it has no more.
template <class Setup, class Tally, class Point>
struct Measurement {
  /// A point before its first run. Throws bad_input for keys that contradict each other.
  Point (*unreached)(const Scenario&, const SourceLocations&,
                     const std::vector<double>& coordinates);
  Setup (*prepare)(const Scenario&, const SourceLocations&, const Workers&);
  /// How many of so many runs a thread may do at once.
  std::uint32_t (*most_at_once)(const Setup&, std::uint32_t runs, int threads);
  /// Runs first ... first + n - 1. Its result is dropped once `*stop` is true.
  Tally (*run)(const Setup&, std::uint32_t first, int n, const std::atomic<bool>* stop) = nullptr;
  /// The ratio, or other figure, at whose interval of a level of confidence stop.rel_ci looks.
  Estimate (*ratio)(const Setup&, const Tally&, double level);
  /// Puts what some runs gave, at least one, into a point.
  void (*describe)(Point&, const Setup&, const Tally&);
  /// Whether a tally can be of so many runs of this point: a file may be damaged. Null: any can.
  bool (*fits)(const Setup&, const Tally&, std::uint32_t runs) = nullptr;

  // ---- experiments whose runs are done in groups ----

  /// A batch is whole groups, and a stop rule looks behind each.
  std::uint32_t group = 1;
  /// In place of `run`, so that is null: a span of each group. The last group may be smaller.
  std::vector<RunSpan<Tally>> (*run_groups)(const Setup&, std::uint32_t first, int n,
                                            const std::atomic<bool>* stop) = nullptr;
  /// The smallest batch of a thread: batches are small at the start and at the end. Null:
  /// most_at_once.
  std::uint32_t (*least_at_once)(const Setup&) = nullptr;

  /// What the points of a sweep say of each other. Null: nothing.
  void (*describe_sweep)(const LoadedScenario&, std::vector<Point>&) = nullptr;

  // ---- experiments that count losses besides that ratio ----

  /// The loss that stop.target_flr looks at. Null: `ratio`.
  Estimate (*loss)(const Setup&, const Tally&, double level) = nullptr;
  /// The number that stop.max_frame_errors limits. Null: there is no such rule, as the runs depend
  /// on each other too much.
  double (*losses)(const Tally&) = nullptr;

  Estimate loss_of(const Setup& setup, const Tally& tally, double level) const {
    return (loss != nullptr ? loss : ratio)(setup, tally, level);
  }
};

}  // namespace sim
