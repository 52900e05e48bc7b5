#pragma once
// Maps of a ratio over two axes of a sweep.
#include <string>
#include <vector>

#include "sim/picture/heat_map.hpp"
#include "sim/scenario/axis.hpp"

namespace sim {

struct MapValue {
  double ratio;
  std::string text;  // with its interval
};

/// One value a point, over the two swept numbers with the most values, or one and a text: a map for
/// each combination of the others' values, but not more than twelve. Empty where there are no two
/// such axes.
std::vector<HeatMap> swept_maps(const std::vector<Axis>& axes, const std::vector<MapValue>& values,
                                const std::string& title, const std::string& what);

}  // namespace sim
