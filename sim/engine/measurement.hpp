#pragma once
// What an experiment tells the engine, which counts its runs (sim/engine/run_counting).
#include <atomic>
#include <cstdint>
#include <vector>

#include "sim/counting/statistics.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

/// How an experiment is measured. Setup: a point with all worked out that its runs share. Tally:
/// what runs count: an empty one has no runs; += adds the runs that follow; serialize is cereal's.
/// Point: what is known of a point; has reached(), whether it has runs.
template <class Setup, class Tally, class Point>
struct Measurement {
  /// A point before its first run. Throws bad_input for keys that contradict each other.
  Point (*unreached)(const Scenario&, const SourceLocations&,
                     const std::vector<double>& coordinates);
  Setup (*prepare)(const Scenario&, const SourceLocations&, const Workers&);
  /// How many of so many runs a thread may do at once.
  std::uint32_t (*most_at_once)(const Setup&, std::uint32_t runs, int threads);
  /// Runs first ... first + n - 1. Its result is dropped once `*stop` is true.
  Tally (*run)(const Setup&, std::uint32_t first, int n, const std::atomic<bool>* stop);
  /// The ratio, or other figure, whose interval of a level of confidence a stop rule looks at.
  Estimate (*ratio)(const Setup&, const Tally&, double level);
  /// Puts what some runs gave, at least one, into a point.
  void (*describe)(Point&, const Setup&, const Tally&);
  /// Whether a tally can be of this point: a file may be damaged. Null: any can.
  bool (*fits)(const Setup&, const Tally&) = nullptr;
};

/// What some first runs of a point took.
struct RunPilot {
  std::vector<double> coordinates;
  std::uint64_t runs = 0;   // that the point shall have
  bool is_at_most = false;  // a stop rule may need fewer
  double setup_s = 0;       // to work it out
  double run_s = 0;         // of a run, by all threads

  double seconds() const { return setup_s + static_cast<double>(runs) * run_s; }
};

}  // namespace sim
