#include "sim/scenario/fidelity.hpp"

#include <algorithm>
#include <array>

namespace sim {
namespace {

constexpr std::array table{FidelityName{"waveform", Fidelity::waveform},
                           FidelityName{"envelope", Fidelity::envelope},
                           FidelityName{"decision", Fidelity::decision}};

}  // namespace

std::span<const FidelityName> fidelities() { return table; }

Fidelity fidelity_of(const SimulationSettings& simulation) {
  return std::ranges::find(table, simulation.fidelity, &FidelityName::name)->fidelity;
}

}  // namespace sim
