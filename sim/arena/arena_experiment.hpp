#pragma once
// An arena at all points of its scenario's sweep: the runs of each, and what is made of them.
#include <string>
#include <vector>

#include "sim/arena/arena_run.hpp"
#include "sim/counting/stop_rule.hpp"
#include "sim/engine/measurement.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// A sender as reports know it.
struct SenderFacts {
  std::string name;
  std::string kind;               // its table's NAME
  double highest_irradiance = 0;  // mW/m2, along the way
};

struct ArenaPoint {
  std::vector<double> coordinates;  // one value an axis
  std::vector<SenderFacts> senders{};
  ArenaTally tally{};  // no runs: never reached
  std::vector<HeardFrame> heard{};
  double duration_s = 0;
  double reach_mw_per_m2 = 0;
  std::uint64_t validity_flags = 0;  // of sim/link/validity
  StopReason stop = StopReason::interrupted;

  bool reached() const { return tally.n_runs > 0; }
};

/// Runs that each thread may do at once: as many as memory allows.
std::uint32_t arena_runs_at_once(const Arena& arena, int threads);

void describe_arena(ArenaPoint& point, const Arena& arena, const ArenaRuns& runs);

/// Whether each sender has its tally, each frame heard its sender, and the tally so many runs.
bool fits_arena(const Arena& arena, const ArenaRuns& runs, std::uint32_t n);

/// Lost of sent, with the interval of runs as clusters.
Estimate frame_loss(const SenderTally& tally);
/// Of all senders, for a stop rule.
Estimate frame_loss(const ArenaRuns& runs, double level);

/// Sum over the devices of a point.
SenderTally together(const ArenaPoint& point);

/// Share of time in which messages that reach the receiver are in the air, each for itself: G.
double offered_load(const ArenaPoint& point, const SenderTally& tally);
/// Share of time of those that were delivered: S.
double throughput(const ArenaPoint& point, const SenderTally& tally);
/// S of pure ALOHA at a load: G exp(-2 G) (Abramson 1970), for many senders of equal messages at
/// random, each of which is lost to any other that overlaps it.
double pure_aloha(double load);

extern const Measurement<Arena, ArenaRuns, ArenaPoint> arena_measurement;

}  // namespace sim
