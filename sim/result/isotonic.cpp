#include "sim/result/isotonic.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace sim {
namespace {

/// Neighbours that share a ratio.
struct Pool {
  LossCount sum;
  std::size_t points;
};

void join_last_two(std::vector<Pool>& pools) {
  const Pool last = pools.back();
  pools.pop_back();
  pools.back().sum.frames += last.sum.frames;
  pools.back().sum.lost += last.sum.lost;
  pools.back().points += last.points;
}

bool last_falls(const std::vector<Pool>& pools) {
  return pools.size() > 1 && pools[pools.size() - 2].sum.ratio() > pools.back().sum.ratio();
}

/// n ln(p), where nothing of what is impossible is no news.
double times_log(double n, double p) { return n == 0 ? 0 : n * std::log(p); }

/// The ratios of greatest likelihood that pass the level just before point `cut`.
std::vector<double> ratios_cut_at(std::size_t cut, const LossCounts& counts, double level) {
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(cut);
  std::vector<double> ratios = isotonic_ratios({counts.begin(), middle});
  for (double& ratio : ratios) ratio = std::min(ratio, level);
  for (const double ratio : isotonic_ratios({middle, counts.end()}))
    ratios.push_back(std::max(ratio, level));
  return ratios;
}

}  // namespace

std::vector<double> isotonic_ratios(const LossCounts& counts) {
  std::vector<Pool> pools;
  for (const LossCount& each : counts) {
    pools.push_back({each, 1});
    while (last_falls(pools)) join_last_two(pools);
  }
  std::vector<double> ratios;
  for (const Pool& pool : pools) ratios.insert(ratios.end(), pool.points, pool.sum.ratio());
  return ratios;
}

double log_likelihood(const LossCounts& counts, const std::vector<double>& ratios) {
  assert(counts.size() == ratios.size());
  double sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i)
    sum += times_log(counts[i].lost, ratios[i]) +
           times_log(counts[i].frames - counts[i].lost, 1 - ratios[i]);
  return sum;
}

LevelCuts isotonic_cuts(const LossCounts& counts, double level, double ci_level) {
  const double best = log_likelihood(counts, isotonic_ratios(counts));
  const double allowed = -std::log((1 - ci_level) / 2);
  const auto is_possible = [&](std::size_t cut) {
    return best - log_likelihood(counts, ratios_cut_at(cut, counts, level)) <= allowed;
  };
  LevelCuts cuts{counts.size(), 0};
  for (std::size_t cut = 0; cut <= counts.size(); ++cut) {
    if (!is_possible(cut)) continue;
    cuts.first = std::min(cuts.first, cut);
    cuts.last = std::max(cuts.last, cut);
  }
  return cuts;
}

}  // namespace sim
