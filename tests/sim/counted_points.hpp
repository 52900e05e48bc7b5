#pragma once
// Points of an experiment, counted at once.
#include <functional>
#include <type_traits>
#include <vector>

#include "sim/engine/run_counting.hpp"

namespace sim {

/// All points of a scenario. After an interrupt the one at hand has the runs that were finished,
/// those behind it none. `on_point`: called after each point that was reached.
template <class Setup, class Tally, class Point>
std::vector<Point> counted_points(
    const Measurement<Setup, Tally, Point>& kind, const LoadedScenario& scenario,
    const Workers& workers = {},
    const std::type_identity_t<std::function<void(const Point&)>>& on_point = {}) {
  RunCounting<Setup, Tally, Point> counting(kind, scenario);
  for (std::size_t i = 0; i < counting.points().size(); ++i) {
    counting.count(i, {workers});
    if (on_point && counting.points()[i].reached()) on_point(counting.points()[i]);
  }
  return counting.points();
}

}  // namespace sim
