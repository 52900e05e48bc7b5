#include "sim/arena/arena.hpp"

#include <algorithm>
#include <cmath>

#include "channel/interference.hpp"
#include "protocol/uart_receivers.hpp"
#include "sim/arena/arena_keys.hpp"
#include "sim/arena/arena_validity.hpp"
#include "sim/failure.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/link/link.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {
namespace {

using dsp::Seconds;

constexpr Seconds lead_out(20e-3);       // dark behind the last: module and UART have finished
constexpr Seconds default_duration(60);  // of a receiver that stands still

channel::Disturbance light_of(const Sender& sender, const LightTrack& track, dsp::Hertz rate) {
  const double highest = track.highest();
  channel::Disturbance light = channel::design_keyed_light(dsp::WattsPerSquareMetre(highest * 1e-3),
                                                           sender.carrier, sender.duty, rate);
  if (track.irradiance.size() == 1 || highest == 0) return light;
  for (const float irradiance : track.irradiance)
    light.gain.push_back(irradiance / static_cast<float>(highest));
  return light;
}

/// Mean light of all senders over the way: part of what makes shot noise and raises the threshold.
dsp::WattsPerSquareMetre mean_light_of(const Arena& arena) {
  double sum = 0;
  for (std::size_t i = 0; i < arena.senders.size(); ++i)
    sum += mean_light(arena.senders[i]) * arena.light[i].mean();
  return dsp::WattsPerSquareMetre(sum * 1e-3);
}

/// Longest that a message may take.
Seconds longest_frame_of(const std::vector<Sender>& senders) {
  Seconds longest;
  for (const Sender& sender : senders) longest = std::max(longest, longest_frame(sender));
  return longest;
}

/// Fewer than senders after a stop.
std::vector<LightTrack> light_tracks(const Scenario& s, const Arena& arena,
                                     const Workers& workers) {
  const Seconds step(channel::gain_step / s.simulation.sample_rate_hz);
  ParallelRuns<LightTrack> parallel({.runs = static_cast<std::uint32_t>(arena.senders.size()),
                                     .most_at_once = 1,
                                     .workers = workers},
                                    [&](std::uint32_t sender, int, const std::atomic<bool>* over) {
                                      return light_track(s, arena.senders[sender], arena.way,
                                                         arena.end, step, over);
                                    });
  return parallel();
}

void set_module(Arena& arena, const Scenario& s) {
  const dsp::Hertz rate(s.simulation.sample_rate_hz);
  const auto ambient = ambient_of(s) + mean_light_of(arena);
  arena.chain = channel::design_chain(s.module,
                                      {.signal = dsp::WattsPerSquareMetre(0),
                                       .ambient = ambient,
                                       .carrier = dsp::Hertz(s.device.carrier_hz),
                                       .duty = s.device.carrier_duty,
                                       .noise_scale = s.noise.scale},
                                      rate);
  arena.has_slow_agc = s.module.agc_attack_db_per_ms > 0;
  channel::ModuleData without = s.module;
  without.agc_attack_db_per_ms = 0;
  arena.without_slow_agc = channel::design_unit(without, ambient, arena.chain);
  arena.reach_mw_per_m2 = channel::emin_in_ambient(s.module, ambient) /
                          band_pass_gain(s.module, dsp::Hertz(s.device.carrier_hz));
  arena.delay = channel::nominal_delay(s.module);
}

void add_lights(Arena& arena, const Scenario& s) {
  const dsp::Hertz rate = arena.chain.sample_rate;
  for (const auto& [name, disturbance] : s.disturbances) {
    arena.disturbances.push_back(disturbance);
    arena.chain.disturbances.push_back(design_disturbance(disturbance, rate));
  }
  for (std::size_t i = 0; i < arena.senders.size(); ++i)
    arena.chain.disturbances.push_back(light_of(arena.senders[i], arena.light[i], rate));
}

}  // namespace

Seconds duration_of(const Scenario& s, const Trajectory& way) {
  const double duration_s = s.settings.of<ArenaSettings>().duration_s;
  if (!std::isnan(duration_s)) return Seconds(duration_s);
  return way.duration() > Seconds(0) ? way.duration() : default_duration;
}

Arena make_arena(const Scenario& scenario, const Workers& workers) {
  Scenario s = scenario;
  s.module = module_of(scenario);
  Arena arena{.senders = make_senders(s), .way = Trajectory(s.path)};
  arena.duration = duration_of(s, arena.way);
  arena.end = arena.duration + longest_frame_of(arena.senders) + lead_out;
  arena.light = light_tracks(s, arena, workers);
  if (arena.light.size() < arena.senders.size()) return arena;  // stopped
  set_module(arena, s);
  add_lights(arena, s);
  arena.receiver_baud = dsp::Hertz(s.device.baud * (1 + s.uart.clock_error_ppm * 1e-6));
  arena.has_monostable = reads_by_monostable(s);
  arena.uart = protocol::find_uart_receiver(s.uart.receiver);
  arena.validity_flags = validity_flags_of(scenario, arena);
  arena.seed = static_cast<std::uint64_t>(s.simulation.seed);
  arena.point = point_hash(scenario);
  return arena;
}

}  // namespace sim
