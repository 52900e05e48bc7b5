#include "sim/location/location_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/failure.hpp"
#include "sim/link/link.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/location/location_keys.hpp"
#include "sim/scenario/source_locations.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

constexpr std::size_t most_receivers = 1000;

std::string given(const std::string& key, const std::string& value, const SourceLocations& places) {
  return fmt::format("{} = {} {}", key, value, place_of(places, key));
}

LightModel model_of(const Scenario& s) {
  LightModel model;
  model.emitter = s.emitter;
  model.axial = channel::axial_intensity(s.emitter, dsp::Amperes(s.led.current_ma * 1e-3),
                                         s.led.temperature_c);
  model.led_celsius = s.led.temperature_c;
  model.led_height_m = s.led.height_mm * 1e-3;
  model.all_round = std::isnan(s.settings.of<LocationScenario>().device_yaw_deg);
  if (!model.all_round) model.yaw = dsp::degrees(s.settings.of<LocationScenario>().device_yaw_deg);
  model.elevation = dsp::degrees(s.led.elevation_deg);
  model.directivity.cosine_power = channel::cosine_power(dsp::degrees(s.photodiode.half_angle_deg));
  model.floor = s.floor;
  return model;
}

/// The lists of the receivers, each as long as the longest.
struct ReceiverPlaces {
  ReceiverPlaces(const LocationScenario& l, const SourceLocations& places)
      : x(numbers("location.x_m", l.x_m, places)),
        y(numbers("location.y_m", l.y_m, places)),
        heading(numbers("location.heading_deg", l.heading_deg, places)) {
    const std::size_t n = std::max({x.size(), y.size(), heading.size()});
    const std::string whole = fmt::format("there are {} receivers", n);
    x = stretched(x, n, given("location.x_m", l.x_m, places), whole);
    y = stretched(y, n, given("location.y_m", l.y_m, places), whole);
    heading = stretched(heading, n, given("location.heading_deg", l.heading_deg, places), whole);
  }

  static std::vector<double> numbers(const std::string& key, const std::string& list,
                                     const SourceLocations& places) {
    std::vector<double> values = parse_values(list, given(key, list, places));
    if (values.size() > most_receivers)
      throw bad_input(fmt::format("{} of {} numbers {}", key, values.size(), place_of(places, key)),
                      fmt::format("at most {} receivers are simulated", most_receivers),
                      "use fewer");
    return values;
  }

  std::vector<double> x, y, heading;
};

Reading reading_at(const Scenario& s, double x, double y, double heading_deg) {
  Reading reading;
  reading.receiver = {.x = x,
                      .y = y,
                      .z = s.receiver.height_mm * 1e-3,
                      .yaw = dsp::degrees(heading_deg + s.receiver.yaw_deg),
                      .elevation = dsp::degrees(s.receiver.tilt_deg)};
  if (!std::isnan(s.settings.of<LocationScenario>().bearing_sigma_deg))
    reading.bearing_deviation = dsp::degrees(s.settings.of<LocationScenario>().bearing_sigma_deg);
  return reading;
}

void refuse_too_near(const std::vector<Reading>& readings, const Scenario& s,
                     const SourceLocations& places) {
  const Position device{s.settings.of<LocationScenario>().device_x_m,
                        s.settings.of<LocationScenario>().device_y_m};
  const double nearest = nearest_receiver(readings, device);
  if (nearest >= least_distance_m) return;
  throw bad_input(
      fmt::format("{} with {}", given("location.device_x_m", fmt::format("{}", device.x), places),
                  given("location.device_y_m", fmt::format("{}", device.y), places)),
      fmt::format("a receiver is {:.3g} m from there", nearest),
      fmt::format("keep {} m from all of them", least_distance_m));
}

std::vector<Reading> readings_of(const Scenario& s, const LightModel& model,
                                 const SourceLocations& places) {
  const ReceiverPlaces at(s.settings.of<LocationScenario>(), places);
  std::vector<Reading> readings;
  for (std::size_t i = 0; i < at.x.size(); ++i)
    readings.push_back(reading_at(s, at.x[i], at.y[i], at.heading[i]));
  refuse_too_near(readings, s, places);
  readings = noiseless_readings(
      model, readings,
      {s.settings.of<LocationScenario>().device_x_m, s.settings.of<LocationScenario>().device_y_m});
  for (Reading& reading : readings)
    reading.deviation_w_per_m2 =
        std::hypot(s.settings.of<LocationScenario>().relative_sigma * reading.irradiance_w_per_m2,
                   s.settings.of<LocationScenario>().sigma_mw_per_m2 * 1e-3);
  return readings;
}

std::optional<Area> scenario_area(const LocationScenario& l, const SourceLocations& places) {
  if (l.area_m.empty()) return std::nullopt;
  const std::string problem = given("location.area_m", l.area_m, places);
  return area_of(parse_values(l.area_m, problem), problem);
}

}  // namespace

Area area_of(const std::vector<double>& numbers, const std::string& problem) {
  constexpr const char* how = "write x from,to and y from,to: -3,3,0,5";
  if (numbers.size() != 4) throw bad_input(problem, "an area has four numbers", how);
  const Area area{numbers[0], numbers[1], numbers[2], numbers[3]};
  if (area.x_min >= area.x_max || area.y_min >= area.y_max)
    throw bad_input(problem, "each range goes up", how);
  return area;
}

LocationTrialsSettings location_settings(const Scenario& s, const SourceLocations& places) {
  LocationTrialsSettings settings;
  settings.locate.model = model_of(s);
  settings.locate.intensity_unknown = s.settings.of<LocationScenario>().intensity_unknown != 0;
  settings.locate.area = scenario_area(s.settings.of<LocationScenario>(), places);
  settings.truth = {s.settings.of<LocationScenario>().device_x_m,
                    s.settings.of<LocationScenario>().device_y_m};
  settings.readings = readings_of(s, settings.locate.model, places);
  settings.trials = static_cast<std::uint32_t>(s.settings.of<LocationScenario>().trials);
  settings.seed = static_cast<std::uint64_t>(s.simulation.seed);
  settings.point = point_hash(s);
  check_readings(settings.locate, settings.readings);
  return settings;
}

}  // namespace sim
