#pragma once
// What counts along a sweep say of a loss of which nothing is known but that it only rises:
// isotonic regression, and the points between which it may pass a level.
#include <cstddef>
#include <vector>

namespace sim {

struct LossCount {
  double frames = 0, lost = 0;

  double ratio() const { return lost / frames; }
};

/// In the direction in which the loss rises; frames > 0.
using LossCounts = std::vector<LossCount>;

/// Natural logarithm of the binomial likelihood, without its constant part.
double log_likelihood(const LossCount& count, double ratio);

/// Of the first 0, 1, 2... points the greatest log-likelihood that ratios have which never fall and
/// are at most `cap` (Barlow, Bartholomew, Bremner & Brunk 1972, section 1.2: pool adjacent
/// violators; cut off at the cap it is still the greatest).
std::vector<double> isotonic_likelihoods(const LossCounts& counts, double cap);

/// The points before `first` are below the level, those from `last` on are at or above it, for
/// certain at the interval's confidence: first = 0 and last = size are the open ends.
struct LevelCuts {
  std::size_t first = 0, last = 0;
};

/// Between which points a rising loss may pass a level: all cuts that the likelihood ratio of
/// Banerjee & Wellner (Ann. Statist. 29 (2001) 1699) does not reject. Its quantile is Chernoff's
/// bound of a binomial tail, (1 - ci_level) / 2 at either end, which also holds where no frame or
/// nearly none was lost: chi-square, which they use, would rule 1 % out after 192 frames without
/// loss, of which one sweep in seven has as many by chance.
LevelCuts isotonic_cuts(const LossCounts& counts, double level, double ci_level);

}  // namespace sim
