#pragma once
// The cells of one variable of a dataset, as numbers and as texts.
#include <cstdint>
#include <string>
#include <vector>

#include "sim/result/dataset.hpp"

namespace sim {

class DatasetCells {
 public:
  /// Empty where the dataset has no such variable. Its interval is in NAME_ci_low and NAME_ci_high.
  DatasetCells(const Dataset& data, const std::string& name);

  bool empty() const { return values_.empty(); }
  std::size_t size() const { return values_.size(); }
  /// NaN where nothing is known, be it that the file lacks it or that nothing bounds it.
  double operator[](std::size_t i) const;
  /// A whole number; 0 where nothing is known.
  std::uint64_t count(std::size_t i) const;
  /// Of those that are known.
  double sum() const;
  /// "0.12 [0.1, 0.15]", "14"; "-" where nothing is known.
  std::string text(std::size_t i) const;

 private:
  bool has_interval(std::size_t i) const;

  std::vector<double> values_, lows_, highs_;
  bool are_counts_ = false;
};

}  // namespace sim
