#pragma once
// The points of a sweep, each measured by trials.
#include <optional>
#include <utility>
#include <vector>

#include "sim/location/trial_sharing.hpp"
#include "sim/report/point_runs.hpp"

namespace sim {

template <class Settings, class Result>
struct TrialPoint {
  std::vector<double> coordinates;  // one value an axis
  Settings settings;
  std::optional<Result> result{};  // nothing: an interrupt came before any trial of it was done

  bool reached() const { return result.has_value(); }
};

/// What measures a point.
template <class Settings, class Result>
struct Measurement {
  Settings (*settings)(const Scenario&, const Places&);  // throws for keys that contradict
  std::optional<Result> (*measure)(const Settings&, const Workers&);
};

/// All points before their first trial, in order; whatever is refused is so here. None after an
/// interrupt.
template <class Settings, class Result>
std::vector<TrialPoint<Settings, Result>> points_to_measure(const LoadedScenario& scenario,
                                                            const Measurement<Settings, Result>& of,
                                                            const Workers& workers) {
  std::vector<TrialPoint<Settings, Result>> points;
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i) {
    if (workers.interrupted()) return {};
    auto coordinates = point_coordinates(scenario.sweep, i);
    auto settings = of.settings(point_scenario(scenario, coordinates), scenario.places);
    points.push_back({std::move(coordinates), std::move(settings)});
  }
  return points;
}

/// Points behind an interrupt stay as they are.
template <class Settings, class Result>
void measure_points(std::vector<TrialPoint<Settings, Result>>& points,
                    const Measurement<Settings, Result>& of, const Workers& workers,
                    const OnPoint<TrialPoint<Settings, Result>>& on_point) {
  for (auto& point : points) {
    if (!workers.interrupted()) point.result = of.measure(point.settings, workers);
    if (on_point && point.reached()) on_point(point);
  }
}

/// Both.
template <class Settings, class Result>
std::vector<TrialPoint<Settings, Result>> measured_points(const LoadedScenario& scenario,
                                                          const Measurement<Settings, Result>& of,
                                                          const Workers& workers) {
  auto points = points_to_measure(scenario, of, workers);
  measure_points(points, of, workers, {});
  return points;
}

}  // namespace sim
