#pragma once
// Whether two results of the same sweep say the same: equal counts, or losses that differ by no
// more than chance.
#include <cstddef>
#include <vector>

#include "sim/result.hpp"

namespace sim {

/// Fisher's exact test, two-sided: how probable a table as improbable as this one is, if both have
/// the same loss. Beyond a million frames in a row of the table by the normal approximation.
double fisher_exact(std::uint64_t lost_a, std::uint64_t frames_a, std::uint64_t lost_b,
                    std::uint64_t frames_b);

struct PointComparison {
  std::size_t point;  // index in both
  double p_value;     // of one and the same frame loss
  bool different;     // after Holm's correction for the number of points
};

struct ResultComparison {
  bool equal = false;                   // the same digest
  std::vector<PointComparison> points;  // those with an estimate of the loss in both
  std::size_t unknown = 0;              // measured in both, without an estimate in one
  std::size_t different() const;
};

/// Both must have the same axes. `alpha`: probability of calling equals different, all points
/// together.
ResultComparison compare(const ExperimentResult& a, const ExperimentResult& b, double alpha);

/// Whether the axes have the same keys and values.
bool same_axes(const ExperimentResult& a, const ExperimentResult& b);

}  // namespace sim
