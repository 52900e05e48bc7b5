#include "sim/arena/arena_validity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/link/validity.hpp"

namespace sim {
namespace {

struct Distances {
  double nearest_m = std::numeric_limits<double>::infinity(), farthest_m = 0;
};

/// Of the receiver from a sender while it is in reach.
Distances distances_in_reach(const Arena& arena, std::size_t sender) {
  const Sender& from = arena.senders[sender];
  const LightTrack& light = arena.light[sender];
  Distances distances;
  for (std::size_t i = 0; i < light.irradiance.size(); ++i) {
    if (light.irradiance[i] < arena.reach_mw_per_m2) continue;
    const Pose2D at = arena.way.at(light.step * static_cast<double>(i));
    const double metres = std::hypot(at.x - from.x_m, at.y - from.y_m);
    distances.nearest_m = std::min(distances.nearest_m, metres);
    distances.farthest_m = std::max(distances.farthest_m, metres);
  }
  return distances;
}

const std::string& longest(const std::vector<std::string>& messages) {
  return *std::ranges::max_element(messages, {}, &std::string::size);
}

/// A link from a sender to the receiver.
Scenario link_from(const Sender& sender, const Scenario& arena) {
  Scenario s = arena;
  s.emitter = sender.emitter;
  s.led.current_ma = sender.current.value * 1e3;
  s.led.height_mm = sender.height_m * 1e3;
  s.device.message = longest(sender.messages);
  s.device.baud = sender.baud.value;
  s.device.carrier_hz = sender.carrier.value;
  s.device.carrier_error_ppm = 0;
  s.device.carrier_duty = sender.duty;
  return s;
}

}  // namespace

std::uint64_t validity_flags_of(const Scenario& scenario, const Arena& arena) {
  std::uint64_t mask = 0;
  for (std::size_t i = 0; i < arena.senders.size(); ++i) {
    const Distances distances = distances_in_reach(arena, i);
    if (std::isinf(distances.nearest_m)) continue;
    Scenario link = link_from(arena.senders[i], scenario);
    for (const double metres : {distances.nearest_m, distances.farthest_m}) {
      link.receiver.range_m = metres;
      mask |= validity_flags_of(link, {.irradiance_mw_per_m2 = arena.light[i].highest()});
    }
  }
  return mask;
}

}  // namespace sim
