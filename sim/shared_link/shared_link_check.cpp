#include "sim/shared_link/shared_link_check.hpp"

#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {

void check_shared_link(const LoadedScenario& scenario) {
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i)
    check_receiver_module(point_scenario(scenario, point_coordinates(scenario.sweep, i)),
                          scenario.places);
}

}  // namespace sim
