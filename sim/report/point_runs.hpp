#pragma once
// The points of a sweep one after the other, each measured by all threads.
#include <cstddef>
#include <functional>
#include <vector>

#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/threads/run_sharing.hpp"

namespace sim {

/// Called after each point that was reached.
template <class Point>
using OnPoint = std::function<void(const Point&)>;

/// All points, in the order of the sweep. After an interrupt the one under way has the runs that
/// were finished, those behind it none. `measure(scenario, coordinates, workers)` gives a Point,
/// which says by reached() whether it has runs.
template <class Point, class Measure>
std::vector<Point> run_points(const LoadedScenario& scenario, const Workers& workers,
                              const OnPoint<Point>& on_point, const Measure& measure) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i) {
    const std::vector<double> coordinates = point_coordinates(scenario.sweep, i);
    points.push_back(measure(point_scenario(scenario, coordinates), coordinates, workers));
    if (on_point && points.back().reached()) on_point(points.back());
  }
  return points;
}

}  // namespace sim
