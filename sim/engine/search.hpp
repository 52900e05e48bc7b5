#pragma once
// Searches along one key for where the frame loss passes a level: points far from it are told in a
// few frames, so a bracket of them is halved until it is narrow. Other than a grid it spends its
// frames where the loss is near the level.
#include <functional>
#include <optional>

#include "sim/counting/tally.hpp"

namespace sim {

struct SearchRange {
  double low, high;
  double tolerance = 0.01;  // of a bracket's width, over its upper end or, with values that are not
                            // positive, over the largest of the range
  bool whole_numbers = false;  // of the key
};

/// The counts at a value of the key; nothing if interrupted.
using CountAt = std::function<std::optional<Tally>(double)>;

/// Calls `count` for value after value: both ends, then inside, each value once; not again once it
/// gives nothing. The loss must rise or fall throughout; of several crossings one is found.
void search(const SearchRange& range, double flr, const CountAt& count);

}  // namespace sim
