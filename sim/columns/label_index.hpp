#pragma once
// The elements of a dimension, each once, in the order in which they are met.
#include <cstddef>
#include <map>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

class LabelIndex {
 public:
  /// The number of a label, which is a new one where it was not met before.
  std::size_t add(const Label& label);
  /// The number of a label that was added before. Throws std::out_of_range for any other.
  std::size_t operator[](const Label& label) const { return places_.at(label); }

  std::size_t size() const { return labels_.size(); }
  bool empty() const { return labels_.empty(); }

  /// Texts, or numbers where the labels are numbers.
  Dataset::Dimension dimension(const VariableFacts& facts) const;

 private:
  std::vector<Label> labels_;
  std::map<Label, std::size_t> places_;
};

}  // namespace sim
