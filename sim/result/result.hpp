#pragma once
// What a link leaves behind: axes, and for each point of their grid the counts, the operating point
// and the cost.
#include <cstdint>
#include <string>
#include <vector>

#include "sim/counting/shard.hpp"
#include "sim/counting/stop_rule.hpp"
#include "sim/counting/tally.hpp"
#include "sim/link/operating_point.hpp"
#include "sim/scenario/axis.hpp"
#include "sim/threads/profile.hpp"

namespace sim {

struct LinkPoint {
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

  /// Whether anything was counted: false for those a stopped run never reached.
  bool reached() const { return tally.n_frames > 0; }
};

struct LinkResult {
  std::string title;
  std::string scenario_toml;  // whole text, enough to repeat the run
  std::string command;        // the command that repeats it
  std::uint64_t seed = 0;
  static constexpr double ci_level = usual_level;  // of all intervals
  std::vector<Shard> shards{Shard{}};              // whose trials these are
  std::vector<Axis> axes;
  std::vector<LinkPoint> points;  // of the grid, row-major; those never reached have no frames
};

/// Whether trials of any point have weights.
bool is_weighted(const std::vector<LinkPoint>& points);
bool is_weighted(const LinkResult& result);

/// Hash (32 hex digits) of all counts and sums of weights of all points with their coordinates and
/// of nothing else: equal digests, equal results.
std::string result_digest(const std::vector<Axis>& axes, const std::vector<LinkPoint>& points);
std::string result_digest(const LinkResult& result);

}  // namespace sim
