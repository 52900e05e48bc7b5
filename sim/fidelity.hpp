#pragma once
// Fidelity: how much of a trial between the LED's wire and the pin is computed, by the key
// simulation.fidelity. A new one is a row of the table in fidelity.cpp.
#include <span>

#include "sim/scenario.hpp"

namespace sim {

enum class Fidelity {
  waveform,  // every sample of light and noise, for any receiver
  envelope,  // one step a carrier cycle, for a module and the device's light alone
  decision   // one decision variable a bit, for matched receivers in white noise
};

struct FidelityName {
  const char* name;
  Fidelity fidelity;
};

std::span<const FidelityName> fidelities();

Fidelity fidelity_of(const SimulationSettings& simulation);

/// Throws Failure(bad_input) where the scenario has what its fidelity cannot compute.
void check_fidelity(const Scenario& scenario, const Places& places);

}  // namespace sim
