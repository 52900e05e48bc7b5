#include "sim/fidelity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "sim/failure.hpp"
#include "sim/link.hpp"
#include "sim/point_scenario.hpp"

namespace sim {
namespace {

constexpr std::array table{FidelityName{"waveform", Fidelity::waveform},
                           FidelityName{"envelope", Fidelity::envelope},
                           FidelityName{"decision", Fidelity::decision}};

constexpr double most_detuned = 0.08, least_level_over_noise = 5, least_q = 7;
constexpr double least_hold_cycles = 1.1, least_integrator_cycles = 2;

constexpr double most_steps = 2e9;

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

std::string number_setting(const std::string& name, double value, const Places& places) {
  return fmt::format("{} = {} {}", name, value, place_of(places, name));
}

/// What there is besides a module and the device's light.
void check_envelope_alone(const Scenario& s, const std::string& asked, const Places& places) {
  if (channel::is_matched(s.module))
    throw bad_input(asked + setting("receiver.module", s.receiver.module, places),
                    "the envelope is that of a module", "use the fidelity decision or waveform");
  if (s.receiver.population != 0)
    throw bad_input(asked + number_setting("receiver.population", s.receiver.population, places),
                    "the envelope is designed once a point", "use 0 or the fidelity waveform");
  if (s.disturbances.empty()) return;
  const auto& [name, disturbance] = *s.disturbances.begin();
  throw bad_input(asked + setting("disturbance." + name + ".kind", disturbance.kind, places),
                  "the envelope is that of the device's light alone",
                  "remove that light or use the fidelity waveform");
}

/// Where it was compared with the waveform (tests/sim/envelope_test.cpp).
void check_envelope_bounds(const Scenario& s, const EnvelopeBounds& bounds,
                           const std::string& asked) {
  const auto refuse = [&](const std::string& what, const char* why) {
    throw bad_input(asked + what, why, "use the fidelity waveform");
  };
  if (!(bounds.detuning <= most_detuned))
    refuse(fmt::format("a carrier {:.2g} of f0 from it", bounds.detuning),
           "the envelope is compared with the waveform up to 0.08");
  if (!(bounds.overload <= 1))
    refuse(fmt::format("{:.3g} of the limiter's irradiance", bounds.overload),
           "the envelope is that of a linear input");
  if (!(bounds.level_over_noise >= least_level_over_noise))
    refuse(
        fmt::format("a threshold of {:.3g} standard deviations of noise", bounds.level_over_noise),
        "the envelope is compared with the waveform from 5 on");
  if (!(s.module.q >= least_q))
    refuse(fmt::format("module.q = {}", s.module.q),
           "the envelope is compared with the waveform from 7 on");
  if (!(s.module.comparator_hold_cycles >= least_hold_cycles))
    refuse(fmt::format("module.comparator_hold_cycles = {}", s.module.comparator_hold_cycles),
           "a pulse a cycle must last a cycle and more");
  if (!(s.module.integrator_cycles >= least_integrator_cycles))
    refuse(fmt::format("module.integrator_cycles = {}", s.module.integrator_cycles),
           "it counts in steps of a cycle");
}

/// Where pauses may be short all of a trial is one stretch (sim/envelope_trial), whose steps are
/// counted in 31 bits.
void check_envelope_length(const EnvelopeBounds& bounds, const std::string& asked) {
  if (bounds.steps <= most_steps) return;
  throw bad_input(
      asked + fmt::format("messages and pauses of {:.4g} carrier cycles in one go", bounds.steps),
      fmt::format("up to {:g} are counted", most_steps),
      "use a longer device.interval_min_ms, so that pauses are left out, or a shorter "
      "device.interval_max_ms, a shorter message or fewer simulation.warmup_messages");
}

void check_envelope(const Scenario& s, const Places& places) {
  const std::string asked = setting(key, s.simulation.fidelity, places) + " with ";
  check_envelope_alone(s, asked, places);
  const EnvelopeBounds bounds = envelope_bounds(s);
  check_envelope_bounds(s, bounds, asked);
  check_envelope_length(bounds, asked);
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
    case Fidelity::envelope:
      return check_envelope(scenario, places);
    case Fidelity::decision:
      return check_decision(scenario, places);
  }
}

}  // namespace sim
