#pragma once
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Throws Failure(bad_input) where the scenario has what its fidelity cannot compute.
void check_fidelity(const Scenario& scenario, const SourceLocations& places);

/// Takes the envelope in place of the waveform where it holds.
void choose_fast_fidelity(Scenario& scenario);

}  // namespace sim
