#include "sim/columns/stop_column.hpp"

#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {

std::vector<std::string> run_stop_names() {
  const auto all = stop_reason_names();
  std::vector<std::string> names(all.begin(), all.end());
  names.at(static_cast<std::size_t>(StopReason::max_frames)) = "all_runs";
  return names;
}

bool has_ratio_rule(const LoadedScenario& scenario) {
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i)
    if (looks_at_ratio(
            rule_of(point_scenario(scenario, point_coordinates(scenario.sweep, i)).stop)))
      return true;
  return false;
}

}  // namespace sim
