#include "sim/scenario/method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "channel/receiver_module.hpp"
#include "protocol/cosys.hpp"
#include "protocol/uart.hpp"
#include "sim/failure.hpp"
#include "sim/scenario/fidelity.hpp"
#include "sim/scenario/source_locations.hpp"

namespace sim {
namespace {

constexpr std::array method_names{MethodName{"brute-force", Method::brute_force},
                                  MethodName{"importance", Method::importance}};

/// Noise and margins of messages are kept, of up to sixteen trials in each thread: 200 MB a
/// million.
constexpr double most_samples = 4e6;

double drawn_samples(const Scenario& s) {
  const auto bits =
      static_cast<double>(protocol::line_bits(protocol::cosys_encode(s.device.message)).size());
  const double seconds =
      bits / s.device.baud + bits / protocol::bits_per_byte * s.device.start_jitter_us * 1e-6;
  return 2 * seconds * s.simulation.sample_rate_hz;  // the message before it is drawn too
}

/// What of a scenario importance sampling cannot do; empty if nothing.
struct Obstacle {
  std::string setting, why, suggestion;
};

Obstacle obstacle_of(const Scenario& s) {
  if (fidelity_of(s.simulation) != Fidelity::waveform)
    return {"simulation.fidelity", "weights are of a waveform's noise",
            "use the fidelity waveform"};
  if (s.noise.scale == 0)
    return {"noise.scale", "without noise there is nothing to draw", "use the method brute-force"};
  if (s.device.pulse_us > 0)
    return {"device.pulse_us", "weights are of bits that are light as a whole",
            "use the method brute-force"};
  if (s.stop.target_flr > 0)
    return {"stop.target_flr", "weighted losses cannot be told from a level frame by frame",
            "use --rel-ci or --max-frame-errors"};
  if (drawn_samples(s) > most_samples)
    return {"device.baud", "the noise of a message would not fit into memory",
            "raise it, shorten the message or lower simulation.sample_rate_hz"};
  if (channel::is_matched(s.module) && !s.disturbances.empty())
    return {"receiver.module", "among other lights it is not known how far its bits are from wrong",
            "remove the disturbances or use the method brute-force"};
  return {};
}

}  // namespace

std::span<const MethodName> methods() { return method_names; }

Method method_of(const SimulationSettings& simulation) {
  return std::ranges::find(method_names, simulation.method, &MethodName::name)->method;
}

void check_method(const Scenario& scenario, const SourceLocations& places) {
  if (method_of(scenario.simulation) == Method::brute_force) return;
  const Obstacle obstacle = obstacle_of(scenario);
  if (obstacle.setting.empty()) return;
  throw bad_input(fmt::format("simulation.method = \"importance\" {} with {} {}",
                              place_of(places, "simulation.method"), obstacle.setting,
                              place_of(places, obstacle.setting)),
                  obstacle.why, obstacle.suggestion);
}

void refuse_weighted(const Scenario& scenario, const std::string& why) {
  if (method_of(scenario.simulation) == Method::brute_force) return;
  throw bad_input("simulation.method = \"" + scenario.simulation.method + "\"", why,
                  "add --set simulation.method=brute-force");
}

}  // namespace sim
