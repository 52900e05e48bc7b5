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
  double p_value;          // of one and the same ratio
  bool different = false;  // after Holm's correction for the number of tests
};

struct DatasetComparison {
  bool equal = false;             // the same digest
  std::vector<CellTest> tests{};  // of all that have an interval in both

  std::size_t different() const;
};

/// Two-sided, that two ratios are one, of their 95 % intervals: their difference is taken to be
/// normal, with an interval made of the ends that face each other (Zou & Donner, Statist. Med. 27
/// (2008) 1693-1702).
double p_value_of_estimates(Estimate a, Estimate b);

/// Both must have the same axes and be of one experiment. `alpha`: probability of calling equals
/// different, all tests together.
DatasetComparison compare(const Dataset& a, const Dataset& b, double alpha);

}  // namespace sim
