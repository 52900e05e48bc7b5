#include "sim/result/isotonic.hpp"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

/// n ln(p), where nothing of what is impossible is no news.
double times_log(double n, double p) { return n == 0 ? 0 : n * std::log(p); }

/// Neighbours that share a ratio, as one.
class Pools {
 public:
  explicit Pools(double cap) : cap_(cap) {}

  void add(LossCount next) {
    while (!pools_.empty() && pools_.back().ratio() > next.ratio()) {
      next.frames += pools_.back().frames;
      next.lost += pools_.back().lost;
      likelihood_.pop_back();
      pools_.pop_back();
    }
    likelihood_.push_back(likelihood() + log_likelihood(next, std::min(next.ratio(), cap_)));
    pools_.push_back(next);
  }

  double likelihood() const { return likelihood_.empty() ? 0 : likelihood_.back(); }

 private:
  double cap_;
  std::vector<LossCount> pools_;
  std::vector<double> likelihood_;  // of each pool and all before it
};

/// From the other end, where what was received only rises.
LossCounts mirrored(const LossCounts& counts) {
  LossCounts received;
  for (const LossCount& each : counts) received.push_back({each.frames, each.frames - each.lost});
  std::ranges::reverse(received);
  return received;
}

}  // namespace

double log_likelihood(const LossCount& count, double ratio) {
  return times_log(count.lost, ratio) + times_log(count.frames - count.lost, 1 - ratio);
}

std::vector<double> isotonic_likelihoods(const LossCounts& counts, double cap) {
  Pools pools(cap);
  std::vector<double> likelihoods{0};
  for (const LossCount& each : counts) {
    pools.add(each);
    likelihoods.push_back(pools.likelihood());
  }
  return likelihoods;
}

LevelCuts isotonic_cuts(const LossCounts& counts, double level, double ci_level) {
  const std::size_t size = counts.size();
  const std::vector<double> before = isotonic_likelihoods(counts, level);
  const std::vector<double> behind = isotonic_likelihoods(mirrored(counts), 1 - level);
  const double least = isotonic_likelihoods(counts, 1).back() + std::log((1 - ci_level) / 2);
  LevelCuts cuts{size, 0};
  for (std::size_t cut = 0; cut <= size; ++cut) {
    if (before[cut] + behind[size - cut] < least) continue;
    cuts.first = std::min(cuts.first, cut);
    cuts.last = std::max(cuts.last, cut);
  }
  return cuts;
}

}  // namespace sim
