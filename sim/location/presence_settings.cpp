#include "sim/location/presence_settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/failure.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/link/link.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/location/location_keys.hpp"
#include "sim/scenario/source_locations.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

constexpr double fewest_samples = 4, most_samples = 200'000;
constexpr std::size_t most_false_alarms = 100;
constexpr double zero_celsius_k = 273.15;

dsp::Hertz off_by(double nominal, double ppm) { return dsp::Hertz(nominal * (1 + ppm * 1e-6)); }

channel::LightMeter meter_of(const Scenario& s) {
  const PresenceScenario& p = s.settings.of<PresenceScenario>();
  return {.photodiode = s.photodiode,
          .feedback_ohm = p.feedback_ohm,
          .temperature_k = s.receiver.temperature_c + zero_celsius_k,
          .sample_rate_hz = p.adc_rate_hz,
          .aperture = p.aperture,
          .adc_bits = static_cast<int>(p.adc_bits),
          .full_scale_v = p.adc_full_scale_v,
          .noise_scale = s.noise.scale};
}

channel::MeteredLight metered_light(const Scenario& s) {
  const channel::Directivity directivity{
      .cosine_power = channel::cosine_power(dsp::degrees(s.photodiode.half_angle_deg))};
  return {.signal = light_of(s, directivity).total(),
          .ambient = ambient_of(s),
          .carrier = off_by(s.device.carrier_hz, s.device.carrier_error_ppm),
          .duty = s.device.carrier_duty};
}

Detector detector_of(const std::string& name) {
  const auto& names = detector_names();
  return static_cast<Detector>(std::ranges::find(names, name) - names.begin());
}

std::size_t samples_in(const std::string& key, double ms, double rate_hz,
                       const SourceLocations& places) {
  const double samples = std::round(ms * 1e-3 * rate_hz);
  if (samples >= fewest_samples && samples <= most_samples)
    return static_cast<std::size_t>(samples);
  throw bad_input(
      fmt::format("{} = {} {}", key, ms, place_of(places, key)),
      fmt::format("at presence.adc_rate_hz = {} it is {:.0f} samples", rate_hz, samples),
      fmt::format("use {:.4g} to {:.4g} ms", fewest_samples / rate_hz * 1e3,
                  most_samples / rate_hz * 1e3));
}

/// Other detectors have none, whatever its key says.
std::size_t reference_samples(const PresenceScenario& p, const SourceLocations& places) {
  if (detector_of(p.detector) != Detector::dc_difference) return 0;
  return samples_in("presence.reference_ms", p.reference_ms, p.adc_rate_hz, places);
}

std::vector<double> false_alarms(const PresenceScenario& p, const SourceLocations& places) {
  const std::string problem = fmt::format("presence.false_alarm = {} {}", p.false_alarm,
                                          place_of(places, "presence.false_alarm"));
  std::vector<double> pfa = parse_values(p.false_alarm, problem);
  if (pfa.size() > most_false_alarms)
    throw bad_input(fmt::format("presence.false_alarm of {} numbers {}", pfa.size(),
                                place_of(places, "presence.false_alarm")),
                    "each has columns of its own",
                    fmt::format("use {} at most", most_false_alarms));
  std::vector<double> sorted = pfa;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end())
    throw bad_input(problem, "one is there twice", "remove one of the two");
  return pfa;
}

std::optional<KeyedMessage> keyed_message(const Scenario& s) {
  if (s.settings.of<PresenceScenario>().keyed == 0) return std::nullopt;
  return KeyedMessage{.message = s.device.message,
                      .baud = off_by(s.device.baud, s.device.clock_error_ppm),
                      .pulse = dsp::Seconds(s.device.pulse_us * 1e-6)};
}

}  // namespace

PresenceSettings presence_settings(const Scenario& s, const SourceLocations& places) {
  const PresenceScenario& p = s.settings.of<PresenceScenario>();
  PresenceSettings settings{
      .meter = meter_of(s),
      .light = metered_light(s),
      .detector = detector_of(p.detector),
      .tuned_to = dsp::Hertz(p.tuned_hz),
      .window_samples = samples_in("presence.window_ms", p.window_ms, p.adc_rate_hz, places),
      .reference_samples = reference_samples(p, places),
      .keyed = keyed_message(s),
      .pfa = false_alarms(p, places),
      .trials = static_cast<std::uint32_t>(p.trials),
      .seed = static_cast<std::uint64_t>(s.simulation.seed),
      .point = point_hash(s)};
  check_presence(settings);
  return settings;
}

}  // namespace sim
