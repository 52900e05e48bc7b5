#pragma once
// Intervals for ratios: exact for independent frames, and widened by the design effect for bits,
// which fail together.
#include <cstdint>

#include "sim/tally.hpp"

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

/// Interval of the bit error ratio with frames as clusters (Korn & Graubard 1998): Clopper-Pearson
/// on the effective number of bits, n / design effect, and by Student's t for as many frames as had
/// errors; its lower end is not below one wrong bit a bad frame, of which there are so many at
/// least. With no error seen, the frames count as trials: nothing is then known about how bits fail
/// together.
Interval bit_error_interval(const Tally& tally, double level);

/// Ratio that is NaN where nothing was counted.
double ratio(std::uint64_t part, std::uint64_t whole);

/// The three ratios of the result file: ber, flr and uer.
Estimate bit_error_ratio(const Tally& tally, double level);
Estimate frame_loss_ratio(const Tally& tally, double level);
Estimate undetected_error_ratio(const Tally& tally, double level);

}  // namespace sim
