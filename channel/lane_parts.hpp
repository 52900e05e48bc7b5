#pragma once
// Any number of trials by kernels that have lanes for some.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <span>
#include <vector>

#include "channel/chain.hpp"
#include "channel/instruction_set.hpp"
#include "dsp/logic_trace.hpp"

namespace channel {

/// The pins of n trials; `part(first, count)` gives those of as many as run at once.
template <class Part>
std::vector<dsp::LogicTrace> pins_in_parts(std::size_t n, InstructionSet set, Part part) {
  const auto at_once = static_cast<std::size_t>(trials_at_once(set));
  std::vector<dsp::LogicTrace> pins;
  for (std::size_t first = 0; first < n; first += at_once)
    std::ranges::move(part(first, std::min(at_once, n - first)), std::back_inserter(pins));
  return pins;
}

/// Indices of trials, the shorter before the longer.
inline std::vector<std::size_t> by_length(std::span<const ChainInput> inputs) {
  std::vector<std::size_t> order(inputs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {},
                           [&](std::size_t trial) { return inputs[trial].drive->end().value; });
  return order;
}

/// all[i] for each of these indices.
template <class T>
std::vector<T> picked(std::span<const T> all, std::span<const std::size_t> which) {
  std::vector<T> some;
  for (const std::size_t i : which) some.push_back(all[i]);
  return some;
}

/// The pins of trials, of which those of like length run together: lanes are then done at about the
/// same time. `part(which)` gives the pins of as many as run at once.
template <class Part>
std::vector<dsp::LogicTrace> pins_by_length(std::span<const ChainInput> inputs, InstructionSet set,
                                            Part part) {
  const std::vector<std::size_t> order = by_length(inputs);
  std::vector<dsp::LogicTrace> sorted = pins_in_parts(
      inputs.size(), set,
      [&](std::size_t first, std::size_t n) { return part(std::span(order).subspan(first, n)); });
  std::vector<dsp::LogicTrace> pins(sorted.size());
  for (std::size_t i = 0; i < order.size(); ++i) pins[order[i]] = std::move(sorted[i]);
  return pins;
}

}  // namespace channel
