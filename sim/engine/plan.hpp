#pragma once
// What a run will take, told from a few trials of each point before any of them is counted.
#include <cstdint>
#include <vector>

#include "sim/counting/shard.hpp"
#include "sim/counting/stop_rule.hpp"
#include "sim/counting/tally.hpp"
#include "sim/engine/measurement.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// A few trials of a point.
struct Pilot {
  std::vector<double> coordinates;
  StopRule rule;  // of the run to come
  Tally tally;
  double seconds_per_frame = 0;  // wall clock
};

/// One for each point, in their order, for a run of that shard; fewer if interrupted.
std::vector<Pilot> run_pilots(const LoadedScenario& scenario, const Shard& shard,
                              const Workers& workers);

/// After how many frames the rule will stop the point, or so; of what no trial showed, as of losses
/// where none was lost, it expects nothing, and the limit of frames remains.
double expected_frames(const Pilot& pilot);

/// Wall-clock time of a point; of all.
double expected_seconds(const Pilot& pilot);
double expected_seconds(const std::vector<Pilot>& pilots);

/// The largest limit of frames a point, in whole groups of eight, at least one group, with which
/// all points together are expected to end within a time.
std::uint64_t frames_within(const std::vector<Pilot>& pilots, double seconds);

/// Of other experiments the runs, from one to `most`.
std::uint64_t runs_within(const std::vector<RunPilot>& pilots, double seconds, double most);

}  // namespace sim
