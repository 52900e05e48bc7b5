#pragma once
// The points of a sweep, each measured by trials.
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "sim/location/trial_sharing.hpp"
#include "sim/point_scenario.hpp"
#include "sim/sweep.hpp"

namespace sim {

template <class Settings, class Result>
struct TrialPoint {
  std::vector<double> coordinates;  // one value an axis
  Settings settings;
  std::optional<Result> result{};  // nothing: an interrupt came before any trial of it was done
};

/// What measures a point.
template <class Settings, class Result>
struct Measurement {
  Settings (*settings)(const Scenario&, const Places&);  // throws for keys that contradict
  std::optional<Result> (*measure)(const Settings&, const TrialSharing&);
};

/// All points, in order; none after an interrupt before the first trial. Whatever is refused is so
/// before that; `on_point` is called after each that has a result.
template <class Settings, class Result>
std::vector<TrialPoint<Settings, Result>> measure_points(
    const LoadedScenario& scenario, const Measurement<Settings, Result>& of,
    const TrialSharing& sharing,
    const std::function<void(const TrialPoint<Settings, Result>&)>& on_point = {}) {
  std::vector<TrialPoint<Settings, Result>> points;
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i) {
    if (sharing.interrupted()) return {};
    auto coordinates = point_coordinates(scenario.sweep, i);
    auto settings = of.settings(point_scenario(scenario, coordinates), scenario.places);
    points.push_back({std::move(coordinates), std::move(settings)});
  }
  for (auto& point : points) {
    if (!sharing.interrupted()) point.result = of.measure(point.settings, sharing);
    if (point.result && on_point) on_point(point);
  }
  return points;
}

}  // namespace sim
