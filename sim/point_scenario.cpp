#include "sim/point_scenario.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cstddef>

#include "sim/failure.hpp"
#include "sim/keys.hpp"
#include "sim/sweep.hpp"

namespace sim {
namespace {

/// `large` must be at least `times` as large as `small`.
struct Limit {
  const Key* small;
  const Key* large;
  double times;
  const char* why;
};

const std::vector<Limit>& limits() {
  static const std::vector<Limit> table{
      {find_key("device.interval_min_ms"), find_key("device.interval_max_ms"), 1,
       "the shortest pause cannot exceed the longest"},
      {find_key("device.carrier_hz"), find_key("simulation.sample_rate_hz"), 4,
       "a carrier period takes at least 4 samples"},
      {find_key("module.centre_hz"), find_key("simulation.sample_rate_hz"), 4,
       "a period of the band-pass takes at least 4 samples"},
      {find_key("device.baud"), find_key("device.carrier_hz"), 4,
       "a bit takes at least 4 carrier periods"},
      {find_key("device.baud"), find_key("simulation.sample_rate_hz"), 100,
       "a bit takes at least 100 samples"},
      {find_key("module.emin_mw_per_m2"), find_key("module.emax_w_per_m2"), 1e-3,
       "the threshold cannot exceed the largest irradiance"},
  };
  return table;
}

[[noreturn]] void refuse_together(const Limit& limit, double small, double large,
                                  const Places& places) {
  const std::string &a = limit.small->name(), &b = limit.large->name();
  throw bad_input(fmt::format("{} = {} {} with {} = {} {}", a, small, place_of(places, a), b, large,
                              place_of(places, b)),
                  limit.why,
                  fmt::format("lower {} to {} or raise {} to {}", a, large / limit.times, b,
                              small * limit.times));
}

void check_together(Scenario& s, const Places& places) {
  for (const Limit& limit : limits()) {
    const double small = limit.small->number(s), large = limit.large->number(s);
    if (large < limit.times * small) refuse_together(limit, small, large, places);
  }
}

/// Above the last point of its curve nothing is known of an LED.
void check_current(const Scenario& s, const Places& places) {
  const double last = s.emitter.intensity_mw_per_sr.x.back();
  if (s.led.current_ma <= last) return;
  throw bad_input(
      fmt::format("led.current_ma = {} {}", s.led.current_ma, place_of(places, "led.current_ma")),
      fmt::format("the data of {} end at {} mA", s.emitter.name, last),
      fmt::format("use at most {}", last));
}

void check_point(Scenario& s, const Places& places) {
  check_together(s, places);
  check_current(s, places);
}

using Setters = std::vector<const Key*>;

Setters setters_of(const std::vector<Axis>& sweep) {
  Setters setters;
  for (const Axis& axis : sweep) setters.push_back(find_key(axis.key));
  return setters;
}

void place_at(Scenario& s, const Setters& setters, const std::vector<double>& coordinates) {
  assert(setters.size() == coordinates.size());
  for (std::size_t i = 0; i < setters.size(); ++i) setters[i]->number(s) = coordinates[i];
}

}  // namespace

std::string place_of(const Places& places, const std::string& key) {
  const auto at = places.find(key);
  if (at != places.end()) return at->second;
  return key.starts_with("module.") ? "from the part" : "by default";
}

Scenario point_scenario(const LoadedScenario& loaded, const std::vector<double>& coordinates) {
  Scenario s = loaded.base;
  place_at(s, setters_of(loaded.sweep), coordinates);
  check_point(s, loaded.places);
  return s;
}

void check_all_points(const LoadedScenario& loaded) {
  const Setters setters = setters_of(loaded.sweep);
  const std::size_t n = count_points(loaded.sweep);
  Scenario s = loaded.base;
  for (std::size_t i = 0; i < n; ++i) {
    place_at(s, setters, point_coordinates(loaded.sweep, i));
    check_point(s, loaded.places);
  }
}

}  // namespace sim
