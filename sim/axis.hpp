#pragma once
#include <string>
#include <vector>

namespace sim {

/// One swept key. The points of a grid are ordered row-major: the last axis varies fastest.
struct Axis {
  std::string key;        // "receiver.range_m"
  std::string unit;       // "m"
  std::string long_name;  // "distance along the floor"
  std::vector<double> values;
};

}  // namespace sim
