#include "sim/check/unpaired_losses.hpp"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

double log_choose(double n, double k) {
  return std::lgamma(n + 1) - std::lgamma(k + 1) - std::lgamma(n - k + 1);
}

/// Of all that were lost, the candidate's: from `from` to `to`, as a probability where its odds are
/// `odds` times the baseline's.
class SharesOfLosses {
 public:
  SharesOfLosses(const LostOf& candidate, const LostOf& baseline, double odds)
      : candidate_(static_cast<double>(candidate.frames)),
        baseline_(static_cast<double>(baseline.frames)),
        lost_(static_cast<double>(candidate.lost + baseline.lost)),
        log_odds_(std::log(odds)) {}

  double fewest() const { return std::max(0.0, lost_ - baseline_); }
  double most() const { return std::min(candidate_, lost_); }

  double probability(double from, double to) const {
    double part = 0, all = 0;
    const double scale = log_weight(mode());
    for (double k = fewest(); k <= most(); ++k) {
      const double weight = std::exp(log_weight(k) - scale);
      all += weight;
      if (k >= from && k <= to) part += weight;
    }
    return std::min(1.0, part / all);
  }

 private:
  double log_weight(double k) const {
    return log_choose(candidate_, k) + log_choose(baseline_, lost_ - k) + k * log_odds_;
  }

  /// Weights rise up to it and fall behind it.
  double mode() const {
    double low = fewest(), high = most();
    while (low < high) {
      const double middle = std::floor((low + high) / 2);
      if (log_weight(middle) < log_weight(middle + 1))
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }

  double candidate_, baseline_, lost_, log_odds_;
};

}  // namespace

double fisher_p_value(const LostOf& candidate, const LostOf& baseline) {
  const SharesOfLosses shares(candidate, baseline, 1);
  return shares.probability(static_cast<double>(candidate.lost), shares.most());
}

double fisher_no_worse_p_value(const LostOf& candidate, const LostOf& baseline, double worse_than) {
  const SharesOfLosses shares(candidate, baseline, worse_than);
  return shares.probability(shares.fewest(), static_cast<double>(candidate.lost));
}

}  // namespace sim
