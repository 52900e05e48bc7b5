#pragma once
// Any number of trials by kernels that have lanes for some.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

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

}  // namespace channel
