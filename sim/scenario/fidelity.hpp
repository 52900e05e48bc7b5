#pragma once
// Fidelity: how much of a trial between the LED's wire and the pin is computed, by the key
// simulation.fidelity. A new one is a row of the table in fidelity.cpp.
#include <span>

#include "sim/scenario/scenario.hpp"

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

}  // namespace sim
