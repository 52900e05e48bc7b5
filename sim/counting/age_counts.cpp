#include "sim/counting/age_counts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sim {

void AgeCounts::add(double age_s) {
  const auto place = static_cast<std::size_t>(std::max(age_s, 0.0) / step_s);
  if (counts_.size() <= place) counts_.resize(place + 1);
  ++counts_[place];
  ++known_;
  sum_ms_ += static_cast<std::uint64_t>(std::llround(std::max(age_s, 0.0) * 1e3));
}

AgeCounts& AgeCounts::operator+=(const AgeCounts& other) {
  counts_.resize(std::max(counts_.size(), other.counts_.size()));
  for (std::size_t i = 0; i < other.counts_.size(); ++i) counts_[i] += other.counts_[i];
  known_ += other.known_;
  unknown_ += other.unknown_;
  sum_ms_ += other.sum_ms_;
  return *this;
}

double AgeCounts::mean_s() const {
  return static_cast<double>(sum_ms_) * 1e-3 / static_cast<double>(known_);
}

double AgeCounts::quantile_s(double share) const {
  if (known_ == 0) return std::numeric_limits<double>::quiet_NaN();
  const double wanted = share * static_cast<double>(known_);
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    below += counts_[i];
    if (static_cast<double>(below) >= wanted) return static_cast<double>(i + 1) * step_s;
  }
  return static_cast<double>(counts_.size()) * step_s;
}

double AgeCounts::unknown_share() const {
  return static_cast<double>(unknown_) / static_cast<double>(known_ + unknown_);
}

}  // namespace sim
