#include "sim/loading/point_scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "sim/components/drawn_part.hpp"
#include "sim/components/part_slot.hpp"
#include "sim/failure.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/loading/fidelity_check.hpp"
#include "sim/scenario/fidelity.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/scenario/method.hpp"
#include "sim/scenario/source_locations.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

constexpr const char* sample_rate_key = "simulation.sample_rate_hz";

/// `large` must be at least `times` as large as `small`.
struct Limit {
  const Key* small;
  const Key* large;
  double times;
  const char* why;
};

const std::vector<Limit>& limits() {
  static const std::vector<Limit> table{
      {find_key("device.carrier_hz"), find_key(sample_rate_key), 4,
       "a carrier period takes at least 4 samples"},
      {find_key("module.centre_hz"), find_key(sample_rate_key), 4,
       "a period of the band-pass takes at least 4 samples"},
      {find_key("device.baud"), find_key("device.carrier_hz"), 4,
       "a bit takes at least 4 carrier periods"},
      {find_key("device.baud"), find_key(sample_rate_key), 100, "a bit takes at least 100 samples"},
      {find_key("module.emin_mw_per_m2"), find_key("module.emax_w_per_m2"), 1e-3,
       "the threshold cannot exceed the largest irradiance"},
  };
  return table;
}

std::vector<Limit> limits_of(const std::string& name, const DisturbanceSettings& d) {
  const auto key = [&](const char* what) { return find_key("disturbance." + name + "." + what); };
  const Key* rate = find_key(sample_rate_key);
  std::vector<Limit> limits;
  if (is_keyed(d))
    limits.push_back({key("carrier_hz"), rate, 4, "a carrier period takes at least 4 samples"});
  if (sends_characters(d)) {
    limits.push_back({key("interval_min_ms"), key("interval_max_ms"), 1,
                      "the shortest pause cannot exceed the longest"});
    limits.push_back({key("baud"), key("carrier_hz"), 4, "a bit takes at least 4 carrier periods"});
    limits.push_back({key("baud"), rate, 100, "a bit takes at least 100 samples"});
  }
  return limits;
}

/// Of all tables that have pauses.
std::vector<Limit> limits_of_pauses() {
  std::vector<Limit> limits;
  for (const Key& shortest : scenario_keys()) {
    const std::size_t end = shortest.name().rfind(".interval_min_ms");
    if (end == std::string::npos) continue;
    limits.push_back({&shortest, find_key(shortest.name().substr(0, end) + ".interval_max_ms"), 1,
                      "the shortest pause cannot exceed the longest"});
  }
  return limits;
}

/// Of the link's light and that of others.
std::vector<Limit> limits_of_light(const Scenario& s) {
  std::vector<Limit> all = limits();
  for (const auto& [name, disturbance] : s.disturbances)
    for (const Limit& limit : limits_of(name, disturbance)) all.push_back(limit);
  return all;
}

/// All limits of a scenario, whatever its numbers are.
std::vector<Limit> limits_of(const Scenario& s) {
  std::vector<Limit> all = limits_of_light(s);
  for (const Limit& limit : limits_of_pauses()) all.push_back(limit);
  for (const auto& [name, device] : s.devices)
    all.push_back({find_key("devices." + name + ".interval_min_ms"),
                   find_key("devices." + name + ".interval_max_ms"), 1,
                   "the shortest pause cannot exceed the longest"});
  return all;
}

[[noreturn]] void refuse_together(const Limit& limit, double small, double large,
                                  const SourceLocations& places) {
  const std::string &a = limit.small->name(), &b = limit.large->name();
  throw bad_input(fmt::format("{} = {} {} with {} = {} {}", a, small, place_of(places, a), b, large,
                              place_of(places, b)),
                  limit.why,
                  fmt::format("lower {} to {} or raise {} to {}", a, large / limit.times, b,
                              small * limit.times));
}

void check_together(Scenario& s, const std::vector<Limit>& limits, const SourceLocations& places) {
  for (const Limit& limit : limits) {
    const double small = limit.small->number(s), large = limit.large->number(s);
    if (large < limit.times * small) refuse_together(limit, small, large, places);
  }
}

/// A pulse is of a carrier, and no longer than the bit that it stands for.
void check_pulse(const Scenario& s, const SourceLocations& places) {
  if (s.device.pulse_us == 0) return;
  constexpr double least_cycles = 4;
  const double least_us = least_cycles / s.device.carrier_hz * 1e6, most_us = 1e6 / s.device.baud;
  const std::string asked = fmt::format("device.pulse_us = {} {}", s.device.pulse_us,
                                        place_of(places, "device.pulse_us"));
  if (s.device.pulse_us < least_us || s.device.pulse_us > most_us)
    throw bad_input(
        asked, "a pulse is of 4 carrier periods at least, and within its bit",
        fmt::format("use {:.3g} to {:.3g}, or 0 for light in the whole bit", least_us, most_us));
  if (channel::is_matched(s.module))
    throw bad_input(asked + " with receiver.module = \"" + s.receiver.module + "\"",
                    "a matched receiver takes the light of whole bits", "remove one of the two");
}

/// Above the last point of its curve nothing is known of an LED.
void check_current(const Scenario& s, const SourceLocations& places) {
  const double last = s.emitter.intensity_mw_per_sr.x.back();
  if (s.led.current_ma <= last) return;
  throw bad_input(
      fmt::format("led.current_ma = {} {}", s.led.current_ma, place_of(places, "led.current_ma")),
      fmt::format("the data of {} end at {} mA", s.emitter.name, last),
      fmt::format("use at most {}", last));
}

/// A unit is one of parts that are not all alike, and the same in each trial.
void check_unit(const Scenario& s, const SourceLocations& places) {
  if (s.receiver.unit == 0) return;
  const std::string asked =
      fmt::format("{} = {} {}", unit_key, s.receiver.unit, place_of(places, unit_key));
  if (s.receiver.population != 0)
    throw bad_input(fmt::format("{} with receiver.population {}", asked,
                                place_of(places, "receiver.population")),
                    "a population draws another unit in each trial", "remove one of the two");
  if (channel::is_matched(s.module))
    throw bad_input(fmt::format("{} with receiver.module = \"{}\" {}", asked, s.receiver.module,
                                place_of(places, "receiver.module")),
                    "an ideal receiver is that of theory, so all units of it are alike",
                    "use a module, or no unit");
  if (!has_unlike_units(s))
    throw bad_input(asked, "all numbers of its LED and floor are known, so all units are alike",
                    "use parts with bounds, or no unit");
}

/// Without noise there is no light of a given Eb/N0.
void check_ebn0(const Scenario& s, const SourceLocations& places) {
  if (std::isnan(s.receiver.ebn0_db) || s.noise.scale > 0) return;
  throw bad_input(
      fmt::format("receiver.ebn0_db = {} {} with noise.scale = 0 {}", s.receiver.ebn0_db,
                  place_of(places, "receiver.ebn0_db"), place_of(places, "noise.scale")),
      "without noise no light has this Eb/N0", "raise noise.scale or remove receiver.ebn0_db");
}

void check_remotes(const Scenario& s, const SourceLocations& places) {
  for (const auto& [name, d] : s.disturbances) {
    if (d.kind != "remote") continue;
    const double frame_ms = longest_frame(d).value * 1e3;
    if (frame_ms < d.repetition_ms) continue;
    const std::string key = "disturbance." + name + ".repetition_ms";
    throw bad_input(fmt::format("{} = {} {}", key, d.repetition_ms, place_of(places, key)),
                    fmt::format("a frame may last {:.4g} ms", frame_ms), "use more than that");
  }
}

void check_point(Scenario& s, const std::vector<Limit>& limits, const SourceLocations& places) {
  check_together(s, limits, places);
  check_remotes(s, places);
  check_current(s, places);
  check_pulse(s, places);
  check_ebn0(s, places);
  check_unit(s, places);
  check_led_temperature(s.emitter, s.led.temperature_c, places);
  check_fidelity(s, places);
  check_method(s, places);
}

/// Where no sample rate is given it is the default, or that whole multiple of it that fast bits and
/// carriers need.
void choose_sample_rate(Scenario& s, const std::vector<Limit>& limits,
                        const SourceLocations& places) {
  if (places.contains(sample_rate_key)) return;
  const Key* key = find_key(sample_rate_key);
  double least = 0;
  for (const Limit& limit : limits)
    if (limit.large == key) least = std::max(least, limit.times * limit.small->number(s));
  double& rate = s.simulation.sample_rate_hz;
  rate = SimulationSettings{}.sample_rate_hz;
  if (least > rate && least <= key->facts.range.high) rate *= std::ceil(least / rate);
}

using Setters = std::vector<const Key*>;

Setters setters_of(const std::vector<Axis>& sweep) {
  Setters setters;
  for (const Axis& axis : sweep) setters.push_back(find_key(axis.key));
  return setters;
}

void place_text(Scenario& s, const Key& key, const std::string& label,
                const std::vector<Scenario>& variants, std::size_t which) {
  key.text(s) = label;
  if (key.facts.type == KeyType::part) part_slot(key.name()).copy(variants[which], s);
}

/// Parts first: numbers hold for any of them. `s` has had no unit of the sweep placed.
void place_at(Scenario& s, const LoadedScenario& loaded, const Setters& setters,
              const std::vector<double>& coordinates) {
  assert(setters.size() == coordinates.size());
  for (std::size_t i = 0; i < setters.size(); ++i) {
    if (setters[i]->is_number()) continue;
    const auto which = static_cast<std::size_t>(coordinates[i]);
    place_text(s, *setters[i], loaded.sweep[i].labels[which], loaded.variants[i], which);
  }
  for (std::size_t i = 0; i < setters.size(); ++i)
    if (setters[i]->is_number()) setters[i]->number(s) = coordinates[i];
  if (is_drawn_by_point(loaded.sweep)) place_unit(s);
}

}  // namespace

void check_led_temperature(const channel::EmitterData& emitter, double celsius,
                           const SourceLocations& places) {
  if (celsius == channel::emitter_reference_celsius) return;
  const auto& known = emitter.relative_intensity_against_temperature.x;
  if (!known.empty() && known.front() <= celsius && celsius <= known.back()) return;
  const std::string asked =
      fmt::format("led.temperature_c = {} {}", celsius, place_of(places, "led.temperature_c"));
  if (known.empty())
    throw bad_input(asked, "the data of " + emitter.name + " hold for one temperature",
                    fmt::format("use {}", channel::emitter_reference_celsius));
  throw bad_input(asked,
                  fmt::format("the data of {} span {} to {} degree_C", emitter.name, known.front(),
                              known.back()),
                  "use a temperature between them");
}

void check_receiver_module(const Scenario& s, const SourceLocations& places) {
  if (!channel::is_matched(s.module)) return;
  throw bad_input(fmt::format("receiver.module = \"{}\" {}", s.receiver.module,
                              place_of(places, "receiver.module")),
                  "an ideal receiver is told when bits are sent, and by one sender only",
                  "use a module");
}

Scenario point_scenario(const LoadedScenario& loaded, const std::vector<double>& coordinates) {
  Scenario s = loaded.base;
  place_at(s, loaded, setters_of(loaded.sweep), coordinates);
  choose_sample_rate(s, limits_of_light(s), loaded.places);
  return s;
}

Scenario checked_point(const LoadedScenario& loaded, const std::vector<double>& coordinates) {
  Scenario s = point_scenario(loaded, coordinates);
  check_point(s, limits_of(s), loaded.places);
  return s;
}

Scenario numbered_point(const LoadedScenario& loaded, std::uint64_t number) {
  const std::size_t points = count_points(loaded.sweep);
  if (number >= points)
    throw bad_input(fmt::format("--point {}", number),
                    fmt::format("the sweep has {} points, counted from 0", points),
                    fmt::format("use one from 0 to {}", points - 1));
  return point_scenario(loaded, point_coordinates(loaded.sweep, number));
}

StopRule rule_of(const StopSettings& stop) {
  return {.max_frames = static_cast<std::uint64_t>(stop.max_frames),
          .max_frame_errors = static_cast<std::uint64_t>(stop.max_frame_errors),
          .rel_ci = stop.rel_ci,
          .target_flr = stop.target_flr};
}

void check_all_points(const LoadedScenario& loaded) {
  const Setters setters = setters_of(loaded.sweep);
  const std::size_t n = count_points(loaded.sweep);
  Scenario s = loaded.base;
  const std::vector<Limit> limits = limits_of(s);
  for (std::size_t i = 0; i < n; ++i) {
    if (is_drawn_by_point(loaded.sweep)) s = loaded.base;
    place_at(s, loaded, setters, point_coordinates(loaded.sweep, i));
    choose_sample_rate(s, limits, loaded.places);
    check_point(s, limits, loaded.places);
  }
}

}  // namespace sim
