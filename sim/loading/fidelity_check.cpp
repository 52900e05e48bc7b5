#include "sim/loading/fidelity_check.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "sim/failure.hpp"
#include "sim/link/link.hpp"
#include "sim/scenario/fidelity.hpp"
#include "sim/scenario/source_locations.hpp"

namespace sim {
namespace {

// The envelope was compared with the waveform up to here (tests/sim/envelope_test.cpp), and to the
// other ends of these keys.
constexpr double most_detuned = 0.08, least_level_over_noise = 5;
constexpr double least_q = 7, most_q = 30;
constexpr double least_front_end_hz = 4e4, most_front_end_hz = 2e5;
// By its steps: a pulse a cycle must last for more than one, and a switch takes more than one.
constexpr double least_hold_cycles = 1.1, least_integrator_cycles = 2;
constexpr double most_steps = 2e9;

constexpr const char* fidelity_key = "simulation.fidelity";

/// "KEY = VALUE in x.toml:3" of a text.
std::string setting(const std::string& name, const std::string& value,
                    const SourceLocations& places) {
  return fmt::format("{} = \"{}\" {}", name, value, place_of(places, name));
}

void check_decision(const Scenario& s, const SourceLocations& places) {
  const std::string asked = setting(fidelity_key, s.simulation.fidelity, places) + " with ";
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

std::string number_setting(const std::string& name, double value, const SourceLocations& places) {
  return fmt::format("{} = {} {}", name, value, place_of(places, name));
}

/// What there is besides a module and the device's light.
void check_envelope_alone(const Scenario& s, const std::string& asked,
                          const SourceLocations& places) {
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

/// In as many digits, three at least, as tell it from a limit that it is beyond.
std::string number_beyond(double limit, double value) {
  const auto text = [](double x, int digits) { return fmt::format("{:.{}g}", x, digits); };
  int digits = 3;
  while (digits < 17 && text(value, digits) == text(limit, digits)) ++digits;
  return text(value, digits);
}

/// Where the envelope is not worked out, or was not compared with the waveform.
class EnvelopeLimits {
 public:
  EnvelopeLimits(std::string asked, const SourceLocations& places)
      : asked_(std::move(asked)), places_(places) {}

  void check_light(const EnvelopeBounds& bounds) const {
    if (!(bounds.detuning <= most_detuned))
      refuse(
          fmt::format("a carrier {} of f0 from it", number_beyond(most_detuned, bounds.detuning)),
          compared("up to", most_detuned));
    if (!(bounds.overload <= 1))
      refuse(number_beyond(1, bounds.overload) + " of the limiter's irradiance",
             "the envelope is that of a linear input");
    if (!(bounds.level_over_noise >= least_level_over_noise))
      refuse(fmt::format("a threshold of {} standard deviations of noise",
                         number_beyond(least_level_over_noise, bounds.level_over_noise)),
             compared("from", least_level_over_noise));
  }
  void check_module(const channel::ModuleData& module) const {
    within(least_q, most_q, "module.q", module.q);
    within(least_front_end_hz, most_front_end_hz, "module.front_end_hz", module.front_end_hz);
    at_least(least_hold_cycles, "module.comparator_hold_cycles", module.comparator_hold_cycles,
             fmt::format("a pulse a cycle must last a cycle and more, from {}", least_hold_cycles));
    at_least(least_integrator_cycles, "module.integrator_cycles", module.integrator_cycles,
             fmt::format("it counts in steps of a cycle, from {}", least_integrator_cycles));
  }

 private:
  void at_least(double least, const char* name, double value, const std::string& why) const {
    if (!(value >= least)) refuse_setting(name, value, why);
  }
  void within(double least, double most, const char* name, double value) const {
    at_least(least, name, value, compared("from", least));
    if (!(value <= most)) refuse_setting(name, value, compared("up to", most));
  }
  static std::string compared(const char* side, double limit) {
    return fmt::format("the envelope is compared with the waveform {} {}", side, limit);
  }
  [[noreturn]] void refuse_setting(const char* name, double value, const std::string& why) const {
    refuse(number_setting(name, value, places_), why);
  }
  [[noreturn]] void refuse(const std::string& what, const std::string& why) const {
    throw bad_input(asked_ + what, why, "use the fidelity waveform");
  }

  std::string asked_;
  const SourceLocations& places_;
};

/// Where pauses may be short all of a trial is one stretch (sim/trial/envelope_trial), whose steps
/// are counted in 31 bits.
void check_envelope_length(const EnvelopeBounds& bounds, const std::string& asked) {
  if (bounds.steps <= most_steps) return;
  throw bad_input(
      asked + fmt::format("messages and pauses of {:.4g} carrier cycles in one go", bounds.steps),
      fmt::format("up to {:g} are counted", most_steps),
      "use a longer device.interval_min_ms, so that pauses are left out, or a shorter "
      "device.interval_max_ms, a shorter message or fewer simulation.warmup_messages");
}

void check_envelope(const Scenario& s, const SourceLocations& places) {
  const std::string asked = setting(fidelity_key, s.simulation.fidelity, places) + " with ";
  check_envelope_alone(s, asked, places);
  const EnvelopeBounds bounds = envelope_bounds(s);
  const EnvelopeLimits limits(asked, places);
  limits.check_light(bounds);
  limits.check_module(s.module);
  check_envelope_length(bounds, asked);
}

}  // namespace

void check_fidelity(const Scenario& scenario, const SourceLocations& places) {
  switch (fidelity_of(scenario.simulation)) {
    case Fidelity::waveform:
      return;
    case Fidelity::envelope:
      return check_envelope(scenario, places);
    case Fidelity::decision:
      return check_decision(scenario, places);
  }
}

void choose_fast_fidelity(Scenario& scenario) {
  if (fidelity_of(scenario.simulation) != Fidelity::waveform) return;
  const std::string waveform = std::exchange(scenario.simulation.fidelity, "envelope");
  try {
    check_fidelity(scenario, {});
  } catch (const Failure&) {
    scenario.simulation.fidelity = waveform;
  }
}

}  // namespace sim
