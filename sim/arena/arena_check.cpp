#include "sim/arena/arena_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>

#include "sim/arena/arena.hpp"
#include "sim/arena/sender.hpp"
#include "sim/arena/trajectory.hpp"
#include "sim/failure.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/source_locations.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/spelling.hpp"

namespace sim {
namespace {

constexpr double longest_run_s = 86400;  // of arena.duration_s too

/// Names of all devices of which some key speaks.
std::set<std::string> named_devices(const LoadedScenario& scenario) {
  std::set<std::string> names;
  for (const auto& [key, place] : scenario.places)
    if (const auto words = split(key, '.'); words.front() == "devices" && words.size() > 2)
      names.emplace(words[1]);
  return names;
}

/// A name with a typo would be one device more.
void check_places(const LoadedScenario& scenario) {
  std::vector<std::string> known, unknown;
  for (const std::string& name : named_devices(scenario)) {
    const std::string key = "devices." + name;
    const bool placed =
        scenario.places.contains(key + ".x_m") || scenario.places.contains(key + ".y_m");
    (placed ? known : unknown).push_back(key);
  }
  if (unknown.empty()) return;
  throw bad_input(unknown.front(), "this device has no place",
                  known.empty() ? fmt::format("give {}.x_m and y_m", unknown.front())
                                : fmt::format("did you mean {}?", nearest(unknown.front(), known)));
}

void check_names(const std::vector<Sender>& senders) {
  std::set<std::string> names;
  for (const Sender& sender : senders)
    if (!names.insert(sender.name).second)
      throw bad_input("devices." + sender.kind, "another device is named " + sender.name + " too",
                      "rename one of the two");
}

void check_currents(const std::vector<Sender>& senders, const SourceLocations& places) {
  for (const Sender& sender : senders) {
    const double last = sender.emitter.intensity_mw_per_sr.x.back();
    const double current_ma = sender.current.value * 1e3;
    const std::string key = "devices." + sender.kind + ".current_ma";
    if (current_ma > last * (1 + 1e-9))
      throw bad_input(fmt::format("{} = {:.6g} {}", key, current_ma, place_of(places, key)),
                      fmt::format("the data of {} end at {} mA", sender.emitter.name, last),
                      fmt::format("use at most {}", last));
  }
}

void check_temperatures(const std::vector<Sender>& senders, double celsius,
                        const SourceLocations& places) {
  for (const Sender& sender : senders) check_led_temperature(sender.emitter, celsius, places);
}

void check_duration(const Scenario& s, const Trajectory& way, const SourceLocations& places) {
  const double seconds = duration_of(s, way).value;
  if (seconds <= longest_run_s) return;
  throw bad_input(fmt::format("path.speed_m_per_s = {} {}", s.path.speed_m_per_s,
                              place_of(places, "path.speed_m_per_s")),
                  fmt::format("the way takes {:.6g} s, a run {} at most", seconds, longest_run_s),
                  "raise it, or set arena.duration_s");
}

void check_point(const Scenario& s, const SourceLocations& places) {
  check_receiver_module(s, places);
  const Trajectory way(s.path);
  check_duration(s, way, places);
  const std::vector<Sender> senders = make_senders(s);
  check_names(senders);
  check_currents(senders, places);
  check_temperatures(senders, s.led.temperature_c, places);
}

}  // namespace

void check_arena(const LoadedScenario& scenario) {
  check_places(scenario);
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i) {
    const Scenario s = point_scenario(scenario, point_coordinates(scenario.sweep, i));
    if (s.devices.empty())
      throw bad_input(scenario.path.string(), "an arena without a device",
                      "add a table [devices.NAME] with its place");
    check_point(s, scenario.places);
  }
}

}  // namespace sim
