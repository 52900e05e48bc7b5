#pragma once
// Intervals for ratios: exact for independent frames, and widened by the design effect for bits,
// which fail together in a frame, and for what hangs together in a run.
#include <cstdint>

#include "sim/counting/tally.hpp"

namespace sim {

struct Interval {
  double low = 0, high = 1;
};

/// A ratio with its interval; all three are NaN where nothing was counted.
struct Estimate {
  double value = 0, low = 0, high = 0;
};

/// Clopper-Pearson interval of a binomial proportion: `successes` of `trials`, two-sided, exact.
/// Real-valued counts are allowed (effective counts); no trials give [0, 1].
Interval clopper_pearson(double successes, double trials, double level);

/// How many events an hour (or whatever `exposure` is in), with Garwood's exact interval of a
/// Poisson count (Biometrika 28 (1936) 437-442): two-sided, so of no event it ends at 3.689 /
/// exposure for 95 %. For events that come independently of each other.
Estimate poisson_rate(std::uint64_t events, double exposure, double level);

/// Interval of the bit error ratio with frames as clusters (Korn & Graubard 1998): Clopper-Pearson
/// on the effective number of bits, n / design effect, and by Student's t for as many frames as had
/// errors; its lower end is not below one wrong bit a bad frame, of which there are so many at
/// least. With no error seen, the frames count as trials: nothing is then known about how bits fail
/// together.
Interval bit_error_interval(const Tally& tally, double level);

/// Of how many clusters (runs, frames), in each of which a part of a whole was counted: what the
/// interval of part over whole needs. In integers, so that the order of adding changes nothing.
struct ClusterSums {
  std::uint64_t n = 0;  // clusters
  std::uint64_t part = 0, whole = 0;
  std::uint64_t part_squared = 0, part_times_whole = 0, whole_squared = 0;

  /// One cluster more, of which `part` <= `whole`. One without anything to count is none.
  void add(std::uint64_t part_of_one, std::uint64_t whole_of_one);
  ClusterSums& operator+=(const ClusterSums& other);
  /// Whether clusters can add up to it: a file may be damaged.
  bool is_sound() const {
    return part <= whole && whole_squared >= whole && (n > 0) == (whole > 0);
  }
  bool operator==(const ClusterSums&) const = default;
  template <class Archive>
  void serialize(Archive& archive) {
    archive(n, part, whole, part_squared, part_times_whole, whole_squared);
  }
};

/// Part over whole where what is counted in a cluster may hang together, with Korn & Graubard's
/// (1998) interval: Clopper-Pearson on the effective number, whole / design effect, by Student's t
/// for so many clusters less one. Never narrower than Clopper-Pearson on the counts, which it is
/// where nothing is seen of a spread: one cluster, nothing or all counted, equal ratios. Never
/// wider than if each cluster were all or nothing.
Estimate clustered_ratio(const ClusterSums& sums, double level);

/// The same for a stop rule: where nothing is seen of a spread, clusters are taken as all or
/// nothing, as those that differ may be yet to come.
Estimate cautious_ratio(const ClusterSums& sums, double level);

/// Ratio that is NaN where nothing was counted.
double ratio(std::uint64_t part, std::uint64_t whole);

/// The three ratios of the result file: ber, flr and uer.
Estimate bit_error_ratio(const Tally& tally, double level);
Estimate frame_loss_ratio(const Tally& tally, double level);
Estimate undetected_error_ratio(const Tally& tally, double level);

}  // namespace sim
