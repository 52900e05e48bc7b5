#pragma once
// A point of a scenario of location as its measurement wants it.
#include <string>
#include <vector>

#include "sim/location/location_trials.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Throws bad_input for keys that contradict each other; `places` are for its messages.
LocationTrialsSettings location_settings(const Scenario& scenario, const SourceLocations& places);

/// x from, to, y from, to. `problem` opens the error line.
Area area_of(const std::vector<double>& numbers, const std::string& problem);

}  // namespace sim
