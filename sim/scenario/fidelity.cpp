#include "sim/scenario/fidelity.hpp"

#include <algorithm>
#include <array>

namespace sim {
namespace {

constexpr std::array fidelity_names{FidelityName{"waveform", Fidelity::waveform},
                                    FidelityName{"envelope", Fidelity::envelope},
                                    FidelityName{"decision", Fidelity::decision}};

}  // namespace

std::span<const FidelityName> fidelities() { return fidelity_names; }

Fidelity fidelity_of(const SimulationSettings& simulation) {
  return std::ranges::find(fidelity_names, simulation.fidelity, &FidelityName::name)->fidelity;
}

}  // namespace sim
