#pragma once
// Whether two results of the same sweep say the same: equal counts, or frame loss and bit error
// ratios that differ by no more than chance.
#include <cstddef>
#include <vector>

#include "sim/result/result.hpp"

namespace sim {

/// Fisher's exact test, two-sided: how probable a table as improbable as this one is, if both have
/// the same loss. Beyond a million frames in a row of the table by the normal approximation.
double fisher_exact(std::uint64_t lost_a, std::uint64_t frames_a, std::uint64_t lost_b,
                    std::uint64_t frames_b);

enum class ComparedRatio { flr, ber };

struct RatioTest {
  std::size_t point;  // index in both
  ComparedRatio ratio;
  double p_value;  // of one and the same ratio
  bool different;  // after Holm's correction for the number of tests
};

struct ResultComparison {
  bool equal = false;              // the same digest
  std::vector<RatioTest> tests{};  // of the ratios that have an estimate in both
  std::size_t compared = 0;        // points measured in both
  std::size_t unknown = 0;         // the same, but without an estimate of either ratio in one
  std::size_t different() const;   // points
};

/// Both must have the same axes. `alpha`: probability of calling equals different, all tests
/// together.
ResultComparison compare(const LinkResult& a, const LinkResult& b, double alpha);

/// Whether they have the same keys and values.
bool same_axes(const std::vector<Axis>& a, const std::vector<Axis>& b);

}  // namespace sim
