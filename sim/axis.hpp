#pragma once
#include <string>
#include <vector>

namespace sim {

/// One swept key. The points of a grid are ordered row-major: the last axis varies fastest.
struct Axis {
  std::string key;                    // "receiver.range_m"
  std::string unit;                   // "m"; empty for texts
  std::string long_name;              // "distance along the floor"
  std::vector<double> values;         // of texts 0, 1, 2...: which of them
  std::vector<std::string> labels{};  // the texts: "TSOP4856"; none for numbers

  bool is_text() const { return !labels.empty(); }
};

}  // namespace sim
