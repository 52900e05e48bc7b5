#include "sim/columns/label_index.hpp"

#include <string>
#include <variant>

namespace sim {
namespace {

template <class T>
std::vector<T> all_of(const std::vector<Label>& labels) {
  std::vector<T> values;
  for (const Label& label : labels) values.push_back(std::get<T>(label));
  return values;
}

}  // namespace

std::size_t LabelIndex::add(const Label& label) {
  const auto [at, added] = places_.emplace(label, labels_.size());
  if (added) labels_.push_back(label);
  return at->second;
}

Dataset::Dimension LabelIndex::dimension(const VariableFacts& facts) const {
  if (!empty() && std::holds_alternative<double>(labels_.front()))
    return {facts, all_of<double>(labels_)};
  return {facts, all_of<std::string>(labels_)};
}

}  // namespace sim
