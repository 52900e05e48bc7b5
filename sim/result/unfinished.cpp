#include "sim/result/unfinished.hpp"

#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {

ExperimentResult unfinished(const LoadedScenario& scenario, const std::string& command) {
  ExperimentResult result;
  result.title = scenario.base.title;
  result.scenario_toml = scenario.text;
  result.command = command;
  result.seed = static_cast<std::uint64_t>(scenario.base.simulation.seed);
  result.axes = scenario.sweep;
  result.points.resize(count_points(scenario.sweep));
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    PointResult& point = result.points[i];
    point.coordinates = point_coordinates(scenario.sweep, i);
    point.rule = rule_of(point_scenario(scenario, point.coordinates).stop);
  }
  return result;
}

}  // namespace sim
