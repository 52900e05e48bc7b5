#pragma once
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Throws Failure(bad_input) where the scenario has what its fidelity cannot compute.
void check_fidelity(const Scenario& scenario, const SourceLocations& places);

}  // namespace sim
