#include "sim/location/location_keys.hpp"

#include <utility>

#include "sim/scenario/detector.hpp"
#include "sim/scenario/key_making.hpp"

namespace sim {
namespace {

std::vector<Key> detection_keys() {
  constexpr SettingsOf<PresenceScenario> at;
  using P = PresenceScenario;
  return {
      text(KeyType::choice, "presence.detector", at, &P::detector, "how light is looked for",
           "replica of the carrier with its phase; power at its frequency; more light than before",
           detector_names()),
      number("presence.tuned_hz", "Hz", from(1, 1e7), at, &P::tuned_hz,
             "carrier as the detector believes it to be"),
      number("presence.window_ms", "ms", from(1e-3, 1e5), at, &P::window_ms,
             "time that a decision looks at"),
      number("presence.reference_ms", "ms", from(1e-3, 1e5), at, &P::reference_ms,
             "time without the device that `dc-difference` compares with"),
      flag("presence.keyed", at, &P::keyed, "the light keys `device.message`",
           "windows lie anywhere inside of it; false: the carrier is on throughout"),
      number_list("presence.false_alarm", "1", from(1e-9, 0.999), at, &P::false_alarm,
                  "probabilities of false alarm that thresholds are set for"),
      no_physics(whole("presence.trials", "1", from(1, 1e8), at, &P::trials,
                       "windows with and windows without light at each point")),
  };
}

std::vector<Key> meter_keys() {
  constexpr SettingsOf<PresenceScenario> at;
  using P = PresenceScenario;
  return {
      text(KeyType::part, "presence.photodiode", at, &P::photodiode, "photodiode",
           "a file in `photodiodes/`"),
      number("presence.feedback_ohm", "Ohm", from(1, 1e12), at, &P::feedback_ohm,
             "volts out for an ampere of photocurrent", "of `receiver.temperature_c`"),
      number("presence.adc_rate_hz", "Hz", from(100, 1e7), at, &P::adc_rate_hz,
             "sample rate of the ADC"),
      whole("presence.adc_bits", "1", from(1, 24), at, &P::adc_bits, "bits of the ADC"),
      number("presence.adc_full_scale_v", "V", from(1e-3, 1e3), at, &P::adc_full_scale_v,
             "full scale of the ADC", "its input begins at 0"),
      number("presence.aperture", "1", from(1e-3, 1), at, &P::aperture,
             "share of the sample interval that a sample is the mean of", "1: an integrating ADC"),
  };
}

std::vector<Key> locating_receiver_keys() {
  constexpr SettingsOf<LocationScenario> at;
  using L = LocationScenario;
  return {
      number_list("location.x_m", "m", from(-1000, 1000), at, &L::x_m, "receivers along x",
                  "or one robot, by its headings; one number holds for all"),
      number_list("location.y_m", "m", from(-1000, 1000), at, &L::y_m, "receivers along y"),
      number_list("location.heading_deg", "degree", from(-360, 360), at, &L::heading_deg,
                  "headings of the receivers", "0: along x; `receiver.yaw_deg` adds"),
      text(KeyType::part, "location.photodiode", at, &L::photodiode, "photodiode of each",
           "a file in `photodiodes/`"),
      number("location.relative_sigma", "1", from(0, 10), at, &L::relative_sigma,
             "deviation of a reading as a share of its light"),
      number("location.sigma_mw_per_m2", "mW/m2", from(0, 1e6), at, &L::sigma_mw_per_m2,
             "deviation of a reading besides that"),
      number("location.bearing_sigma_deg", "degree", from(1e-3, 360), at, &L::bearing_sigma_deg,
             "deviation of a bearing", "unset: none is measured"),
  };
}

std::vector<Key> located_device_keys() {
  constexpr SettingsOf<LocationScenario> at;
  using L = LocationScenario;
  return {
      number("location.device_x_m", "m", from(-1000, 1000), at, &L::device_x_m,
             "place of the device along x"),
      number("location.device_y_m", "m", from(-1000, 1000), at, &L::device_y_m,
             "place of the device along y"),
      number("location.device_yaw_deg", "degree", from(-360, 360), at, &L::device_yaw_deg,
             "direction of its LED, which is known", "unset: as bright to all sides"),
      flag("location.intensity_unknown", at, &L::intensity_unknown,
           "the LED's intensity is to be found too", "needs area_m"),
      number_list("location.area_m", "m", from(-1e4, 1e4), at, &L::area_m,
                  "where the device may be: x from, to, y from, to",
                  "empty: as far as the light allows"),
      no_physics(whole("location.trials", "1", from(1, 1e7), at, &L::trials,
                       "times that locating is tried at each point")),
  };
}

std::vector<Key> presence_keys() {
  std::vector<Key> keys = detection_keys();
  for (Key& key : meter_keys()) keys.push_back(std::move(key));
  return all_younger(std::move(keys));
}

std::vector<Key> location_keys() {
  std::vector<Key> keys = locating_receiver_keys();
  for (Key& key : located_device_keys()) keys.push_back(std::move(key));
  return all_younger(std::move(keys));
}

}  // namespace

constinit const ExperimentKind presence_kind{
    .name = "presence",
    .tables = {"presence.", "device.message", "device.baud", "device.pulse_us",
               "device.clock_error_ppm", "device.carrier_", "led.yaw_deg", "receiver.range_m",
               "receiver.bearing_deg", "receiver.temperature_c", "ambient.", "noise."},
    .has_modules = false,
    .amount = "presence.trials",
    .keys = presence_keys};

constinit const ExperimentKind location_kind{.name = "location",
                                             .tables = {"location."},
                                             .has_modules = false,
                                             .amount = "location.trials",
                                             .keys = location_keys};

}  // namespace sim
