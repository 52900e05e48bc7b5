#pragma once
// A point of a scenario of presence as its measurement wants it.
#include "sim/location/presence.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Throws bad_input for keys that contradict each other; `places` are for its messages.
PresenceSettings presence_settings(const Scenario& scenario, const SourceLocations& places);

}  // namespace sim
