#pragma once
// What an experiment leaves behind: axes, and for each point of their grid the counts, the
// operating point and the cost. The store, the table and the JSON printer all read this and nothing
// else.
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "sim/counting/shard.hpp"
#include "sim/counting/stop_rule.hpp"
#include "sim/counting/tally.hpp"
#include "sim/link/operating_point.hpp"
#include "sim/scenario/axis.hpp"
#include "sim/threads/profile.hpp"

namespace sim {

struct PointResult {
  std::vector<double> coordinates{};  // one value an axis
  OperatingPoint operating{};
  Tally tally{};
  StopReason stop = StopReason::max_frames;
  StopRule rule{};                   // of its scenario
  double elapsed_s = 0;              // wall clock
  double simulated_s = 0;            // of the link's own time
  std::uint64_t n_samples = 0;       // waveform samples simulated
  std::uint64_t validity_flags = 0;  // of the models' validity: bits of sim/link/validity
  std::uint64_t alarms = 0;          // bits of sim/result/alarms
  Profile profile{};                 // where somebody asked for it; not kept in files
};

struct ExperimentResult {
  std::string title;
  std::string scenario_toml;  // whole text, enough to repeat the run
  std::string command;        // the command that repeats it
  std::uint64_t seed = 0;
  double ci_level = 0.95;
  std::vector<Shard> shards{Shard{}};  // whose trials these are
  std::vector<Axis> axes;
  std::vector<PointResult>
      points;  // all points of the grid, row-major; unfinished ones have n_frames 0
};

/// One variable of the result file and of the JSON report: the table of them drives both, and the
/// digest too, which covers every column that is a count of Tally, or a sum of its weights.
struct LinkColumn {
  using Real = double (*)(const PointResult&, double ci_level);
  using Sum = double& (*)(Weighted&);
  const char* name;
  const char* unit;
  const char* long_name;
  std::variant<std::uint64_t Tally::*, std::uint64_t PointResult::*, StopReason PointResult::*,
               Real, Sum>
      value;
  bool weighted = false;  // only of results of importance sampling
};

/// Whether trials of any point have weights.
bool is_weighted(const ExperimentResult& result);

/// The table's columns that a result has.
std::vector<const LinkColumn*> columns_of(const ExperimentResult& result);

/// The table. At a point never reached the rates and the operating point are NaN.
std::span<const LinkColumn> columns();

/// Whether anything was counted at this point: false for those a stopped run never reached.
bool measured(const PointResult& point);

/// Hash (32 hex digits) of all counts and sums of weights of all points with their coordinates and
/// of nothing else:
/// equal digests, equal results.
std::string result_digest(const ExperimentResult& result);

}  // namespace sim
