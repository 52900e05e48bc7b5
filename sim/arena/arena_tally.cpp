#include "sim/arena/arena_tally.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace sim {

void Latency::add(dsp::Seconds first_end) {
  const auto us = static_cast<std::uint64_t>(std::llround(first_end.value * 1e6));
  ++n_runs_heard;
  sum_us += us;
  worst_us = std::max(worst_us, us);
}

double Latency::mean_s() const {
  return static_cast<double>(sum_us) * 1e-6 / static_cast<double>(n_runs_heard);
}

double Latency::worst_s() const {
  if (n_runs_heard == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(worst_us) * 1e-6;
}

Latency& Latency::operator+=(const Latency& other) {
  n_runs_heard += other.n_runs_heard;
  sum_us += other.sum_us;
  worst_us = std::max(worst_us, other.worst_us);
  return *this;
}

std::uint64_t SenderTally::messages() const {
  return std::accumulate(by_cause.begin(), by_cause.end(), std::uint64_t{0});
}

SenderTally& SenderTally::operator+=(const SenderTally& other) {
  for (std::size_t i = 0; i < loss_causes; ++i) by_cause[i] += other.by_cause[i];
  n_in_reach += other.n_in_reach;
  n_overlapped += other.n_overlapped;
  n_captured += other.n_captured;
  airtime_us += other.airtime_us;
  airtime_in_reach_us += other.airtime_in_reach_us;
  airtime_delivered_us += other.airtime_delivered_us;
  latency += other.latency;
  losses += other.losses;
  return *this;
}

ArenaTally& ArenaTally::operator+=(const ArenaTally& other) {
  senders.resize(std::max(senders.size(), other.senders.size()));
  for (std::size_t i = 0; i < other.senders.size(); ++i) senders[i] += other.senders[i];
  n_runs += other.n_runs;
  any += other.any;
  losses += other.losses;
  n_false += other.n_false;
  return *this;
}

}  // namespace sim
