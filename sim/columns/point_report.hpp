#pragma once
// What an experiment says of its points.
#include <string>

#include "sim/columns/column.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

template <class Point>
struct PointReport {
  const Columns<Point>& (*columns)();
  /// What more there is to say of a single point; null: nothing.
  std::string (*details)(const LoadedScenario&, const Point&);
};

}  // namespace sim
