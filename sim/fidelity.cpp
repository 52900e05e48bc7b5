#include "sim/fidelity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "sim/failure.hpp"
#include "sim/point_scenario.hpp"

namespace sim {
namespace {

constexpr std::array table{FidelityName{"waveform", Fidelity::waveform},
                           FidelityName{"decision", Fidelity::decision}};

constexpr const char* key = "simulation.fidelity";

/// "KEY = VALUE in x.toml:3" of a text.
std::string setting(const std::string& name, const std::string& value, const Places& places) {
  return fmt::format("{} = \"{}\" {}", name, value, place_of(places, name));
}

void check_decision(const Scenario& s, const Places& places) {
  const std::string asked = setting(key, s.simulation.fidelity, places) + " with ";
  if (!channel::is_matched(s.module))
    throw bad_input(asked + setting("receiver.module", s.receiver.module, places),
                    "a module has more to it than one decision a bit",
                    "use ideal-coherent, ideal-noncoherent or the fidelity waveform");
  if (s.disturbances.empty()) return;
  const auto& [name, disturbance] = *s.disturbances.begin();
  throw bad_input(asked + setting("disturbance." + name + ".kind", disturbance.kind, places),
                  "decisions are drawn for white noise alone",
                  "remove that light or use the fidelity waveform");
}

}  // namespace

std::span<const FidelityName> fidelities() { return table; }

Fidelity fidelity_of(const SimulationSettings& simulation) {
  return std::ranges::find(table, simulation.fidelity, &FidelityName::name)->fidelity;
}

void check_fidelity(const Scenario& scenario, const Places& places) {
  switch (fidelity_of(scenario.simulation)) {
    case Fidelity::waveform:
      return;
    case Fidelity::decision:
      return check_decision(scenario, places);
  }
}

}  // namespace sim
