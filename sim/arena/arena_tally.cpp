#include "sim/arena/arena_tally.hpp"

#include <algorithm>
#include <numeric>

namespace sim {

std::uint64_t SenderTally::messages() const {
  return std::accumulate(fate.begin(), fate.end(), std::uint64_t{0});
}

SenderTally& SenderTally::operator+=(const SenderTally& other) {
  for (std::size_t i = 0; i < frame_fates; ++i) fate[i] += other.fate[i];
  n_in_reach += other.n_in_reach;
  n_overlapped += other.n_overlapped;
  n_captured += other.n_captured;
  airtime_us += other.airtime_us;
  airtime_in_reach_us += other.airtime_in_reach_us;
  airtime_delivered_us += other.airtime_delivered_us;
  n_runs_heard += other.n_runs_heard;
  latency_us += other.latency_us;
  worst_latency_us = std::max(worst_latency_us, other.worst_latency_us);
  return *this;
}

ArenaTally& ArenaTally::operator+=(const ArenaTally& other) {
  if (senders.empty()) senders.resize(other.senders.size());
  for (std::size_t i = 0; i < other.senders.size(); ++i) senders[i] += other.senders[i];
  n_runs += other.n_runs;
  n_false += other.n_false;
  return *this;
}

}  // namespace sim
