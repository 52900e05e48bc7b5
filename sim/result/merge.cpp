#include "sim/result/merge.hpp"

#include <algorithm>
#include <cassert>

namespace sim {
namespace {

/// What ended both: that it was interrupted, or else that there were enough losses, before that
/// there were no more trials.
StopReason reason_of_both(const PointResult& a, const PointResult& b) {
  for (const PointResult* p : {&a, &b})
    if (!measured(*p) || p->stop == StopReason::interrupted) return StopReason::interrupted;
  return a.stop == StopReason::max_frames ? b.stop : a.stop;
}

void add(PointResult& sum, const PointResult& other) {
  sum.stop = reason_of_both(sum, other);
  sum.tally += other.tally;
  sum.elapsed_s += other.elapsed_s;
  sum.simulated_s += other.simulated_s;
  sum.n_samples += other.n_samples;
}

}  // namespace

void add(ExperimentResult& sum, const ExperimentResult& other) {
  assert(sum.points.size() == other.points.size());
  for (std::size_t i = 0; i < sum.points.size(); ++i) add(sum.points[i], other.points[i]);
  sum.shards.insert(sum.shards.end(), other.shards.begin(), other.shards.end());
  std::ranges::sort(sum.shards, comes_before);
}

const Shard* overlapping(const std::vector<Shard>& shards, const std::vector<Shard>& more) {
  for (const Shard& shard : more)
    if (std::ranges::any_of(shards, [&](const Shard& s) { return overlap(s, shard); }))
      return &shard;
  return nullptr;
}

}  // namespace sim
