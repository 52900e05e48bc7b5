#pragma once
#include <cstdint>
#include <vector>

namespace sim {

/// How old something is known to be, looked at at even times: a count for each tenth of a second.
class AgeCounts {
 public:
  static constexpr double step_s = 0.1;

  void add(double age_s);
  void add_unknown() { ++unknown_; }
  AgeCounts& operator+=(const AgeCounts& other);

  /// NaN where nothing was ever known.
  double mean_s() const;
  /// Age that a share of the looks does not exceed, to a step above.
  double quantile_s(double share) const;
  double unknown_share() const;
  std::uint64_t known() const { return known_; }
  std::uint64_t unknown() const { return unknown_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(counts_, known_, unknown_, sum_ms_);
  }

 private:
  std::vector<std::uint64_t> counts_;
  std::uint64_t known_ = 0, unknown_ = 0;
  std::uint64_t sum_ms_ = 0;
};

}  // namespace sim
