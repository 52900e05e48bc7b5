#include "sim/result/unfinished.hpp"

#include <utility>

#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {

LinkResult link_result(const LoadedScenario& scenario, const std::string& command,
                       std::vector<LinkPoint> points) {
  LinkResult result;
  result.title = scenario.base.title;
  result.scenario_toml = scenario.text;
  result.command = command;
  result.seed = static_cast<std::uint64_t>(scenario.base.simulation.seed);
  result.axes = scenario.sweep;
  result.points = std::move(points);
  return result;
}

LinkResult unfinished(const LoadedScenario& scenario, const std::string& command) {
  std::vector<LinkPoint> points(count_points(scenario.sweep));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].coordinates = point_coordinates(scenario.sweep, i);
    points[i].rule = rule_of(point_scenario(scenario, points[i].coordinates).stop);
  }
  return link_result(scenario, command, std::move(points));
}

}  // namespace sim
