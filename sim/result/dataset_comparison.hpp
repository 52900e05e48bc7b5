#pragma once
// Whether two results of an experiment that is not a link say the same: equal counts, or ratios and
// rates that differ by no more than chance.
#include <cstddef>
#include <string>
#include <vector>

#include "sim/counting/statistics.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

/// A ratio of both results, at one point and element.
struct CellTest {
  std::string name;   // of the variable
  std::string place;  // "receiver.range_m = 2 m, sender A"; empty of a single one
  Estimate one, other;
  double p_value;          // of the hypothesis that both are equal
  bool different = false;  // after Holm's correction for the number of tests
};

struct DatasetComparison {
  bool equal = false;             // the same digest
  std::vector<CellTest> tests{};  // of all that have an interval in both
  std::size_t unknown = 0;        // ratios that only one of the two has

  std::size_t different() const;
};

/// The two-sided p value of the hypothesis that two ratios are equal. It is computed from their
/// 95 % intervals: from the ends that face each other (Zou & Donner, Statist. Med. 27 (2008)
/// 1693-1702), in Student's t with so many degrees of freedom, as the intervals are.
double p_value_of_estimates(Estimate a, Estimate b, double degrees_of_freedom);

/// Both must have the same axes and be of one experiment. `alpha`: probability of calling equals
/// different, all tests together. The degrees of freedom are the runs of a point less one, of the
/// result that has fewer.
DatasetComparison compare(const Dataset& a, const Dataset& b, double alpha);

}  // namespace sim
