#include "sim/link/link.hpp"

#include <xxhash.h>

#include <cmath>
#include <utility>

#include "channel/conditions.hpp"
#include "channel/emitter.hpp"
#include "channel/noise.hpp"
#include "protocol/cosys.hpp"
#include "protocol/uart_receivers.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/link/importance_link.hpp"
#include "sim/link/matched.hpp"
#include "sim/link/sampled_theory.hpp"
#include "sim/link/validity.hpp"
#include "sim/scenario/canonical_text.hpp"
#include "sim/scenario/fidelity.hpp"
#include "sim/scenario/method.hpp"

namespace sim {
namespace {

dsp::Hertz off_by(double nominal_hz, double ppm) {
  return dsp::Hertz(nominal_hz * (1 + ppm * 1e-6));
}

double in_db(double power_ratio) { return 10 * std::log10(power_ratio); }

dsp::Hertz true_baud(const Scenario& s) { return off_by(s.device.baud, s.device.clock_error_ppm); }

/// The rate of bits that would be as long as the light of a zero bit is: for its energy.
dsp::Hertz light_rate(const Scenario& s) {
  return s.device.pulse_us > 0 ? dsp::Hertz(1e6 / s.device.pulse_us) : true_baud(s);
}

channel::LightSettings light_settings(const Scenario& s) {
  return {.signal = light_of(s).total() * colour_response(s.module, s.emitter, s.led.temperature_c),
          .ambient = ambient_of(s),
          .carrier = off_by(s.device.carrier_hz, s.device.carrier_error_ppm),
          .duty = s.device.carrier_duty,
          .noise_scale = s.noise.scale};
}

/// The scenario with the part as it is under its conditions, and what light it gets.
struct PointLight {
  Scenario scenario;
  channel::LightSettings light;
};

PointLight point_light(const Scenario& scenario) {
  Scenario s = scenario;
  s.module = module_of(scenario);
  channel::LightSettings light = light_settings(s);
  if (!std::isnan(s.receiver.ebn0_db))
    light.signal = signal_for_ebn0(s.module, light, light_rate(s), s.receiver.ebn0_db);
  return {std::move(s), light};
}

/// Signal: the carrier's fundamental. Noise: what shot and thermal noise put into the module with
/// the carrier on. SNR is taken behind the band-pass, or in the bandwidth of a bit that a matched
/// receiver has; Eb/N0 at the input, half of the bits being light (average-energy convention:
/// coherent OOK has BER = Q(sqrt(Eb/N0))), or having a pulse of it.
OperatingPoint operating_point(const Scenario& s, const channel::LightSettings& light) {
  const dsp::Hertz baud = light_rate(s);
  const double ebn0 = ebn0_of(s.module, light, baud);
  const bool matched = channel::is_matched(s.module);
  const dsp::Hertz bandwidth = matched ? baud : channel::noise_bandwidth(s.module);
  const double gain = matched ? 1 : band_pass_gain(s.module, light.carrier);
  return {.irradiance_mw_per_m2 = light.signal.value * 1e3,
          .ambient_w_per_m2 = light.ambient.value,
          .snr_db = in_db(ebn0 * 2 * (baud / bandwidth) * gain * gain),
          .snr_bandwidth_hz = bandwidth.value,
          .ebn0_db = in_db(ebn0)};
}

/// What sends, and when.
void set_device(Link& link, const Scenario& s) {
  link.message = s.device.message;
  link.bytes = protocol::cosys_encode(s.device.message);
  link.device_baud = true_baud(s);
  link.pulse = dsp::Seconds(s.device.pulse_us * 1e-6);
  link.start_jitter = dsp::Seconds(s.device.start_jitter_us * 1e-6);
  link.interval_min = dsp::Seconds(s.device.interval_min_ms * 1e-3);
  link.interval_max = dsp::Seconds(s.device.interval_max_ms * 1e-3);
  link.warmup_messages = static_cast<int>(s.simulation.warmup_messages);
}

void add_disturbances(Link& link, const Scenario& s) {
  for (const auto& [name, disturbance] : s.disturbances) {
    link.disturbances.push_back(disturbance);
    link.chain.disturbances.push_back(design_disturbance(disturbance, link.chain.sample_rate));
  }
}

}  // namespace

std::uint32_t point_hash(const Scenario& scenario) {
  const std::string text = canonical_text(scenario);
  return XXH32(text.data(), text.size(), 0);
}

double band_pass_gain(const channel::ModuleData& module, dsp::Hertz f) {
  const double ratio = f.value / module.centre_hz;
  return 1 / std::hypot(1.0, module.q * (ratio - 1 / ratio));
}

bool reads_by_monostable(const Scenario& s) {
  return s.device.pulse_us > 0 && s.uart.monostable != 0;
}

channel::ModuleData module_of(const Scenario& s) {
  return channel::under({.celsius = s.receiver.temperature_c,
                         .supply_v = s.receiver.supply_v,
                         .ripple_mv_rms = s.receiver.supply_ripple_mv,
                         .ripple_at = channel::ripple_frequency(s.receiver.supply_ripple_at)},
                        s.module);
}

double colour_response(const channel::ModuleData& module, const channel::EmitterData& led,
                       double celsius) {
  constexpr double nm = 1e9;
  return channel::spectral_response(module, channel::wavelength(led, celsius).value * nm);
}

channel::ReceivedLight light_of(const Scenario& s) {
  return light_of(
      s, {.relative_distance = s.module.directivity, .vertical = s.module.directivity_vertical});
}

channel::ReceivedLight light_of(const Scenario& s, const channel::Directivity& directivity) {
  const channel::Pose led{.z = s.led.height_mm * 1e-3,
                          .yaw = dsp::degrees(s.led.yaw_deg),
                          .elevation = dsp::degrees(s.led.elevation_deg)};
  const channel::Pose receiver =
      channel::receiver_pose(dsp::Metres(s.receiver.range_m), dsp::degrees(s.receiver.bearing_deg),
                             dsp::Metres(s.receiver.height_mm * 1e-3),
                             dsp::degrees(s.receiver.yaw_deg), dsp::degrees(s.receiver.tilt_deg));
  const auto axial = channel::axial_intensity(s.emitter, dsp::Amperes(s.led.current_ma * 1e-3),
                                              s.led.temperature_c);
  return channel::received_light(s.emitter, axial, led, directivity, receiver, s.floor,
                                 s.led.temperature_c);
}

dsp::Hertz carrier_of(const Link& link) {
  return link.chain.carrier.step * 0x1p-32 * link.chain.sample_rate;
}

EnvelopeBounds envelope_bounds(const Scenario& scenario) {
  const PointLight point = point_light(scenario);
  const auto chain = channel::design_chain(point.scenario.module, point.light,
                                           dsp::Hertz(scenario.simulation.sample_rate_hz));
  const channel::ModuleData& module = point.scenario.module;
  Link link;
  set_device(link, scenario);
  return {.detuning = std::abs(point.light.carrier.value / module.centre_hz - 1),
          .overload = point.light.signal.value / module.emax_w_per_m2,
          .level_over_noise = channel::comparator_level(module, point.light.ambient) /
                              channel::noise_deviation(module, chain),
          .steps = longest_stretch(link, channel::design_envelope(module, point.light, chain))};
}

Link make_link(const Scenario& scenario) {
  const auto [s, light] = point_light(scenario);
  Link link;
  set_device(link, s);
  link.chain = channel::design_chain(s.module, light, dsp::Hertz(s.simulation.sample_rate_hz));
  link.delay = channel::nominal_delay(s.module);
  link.module = s.module;
  link.ambient = light.ambient;
  add_disturbances(link, s);
  link.population = s.receiver.population != 0;
  link.draws_constants = s.receiver.population == population_with_constants;
  link.receiver_baud = off_by(s.device.baud, s.uart.clock_error_ppm);
  link.uart = protocol::find_uart_receiver(s.uart.receiver);
  link.has_monostable = reads_by_monostable(s);
  link.seed = static_cast<std::uint64_t>(s.simulation.seed);
  link.point = point_hash(scenario);
  link.operating = operating_point(s, light);
  link.validity_flags = validity_flags_of(scenario, link.operating);
  if (fidelity_of(s.simulation) == Fidelity::envelope)
    link.envelope = make_envelope_link(link, light);
  if (const auto matched =
          matched_receiver(s.module, light, link.chain, link.device_baud, link.bytes)) {
    link.ideal = matched->design;
    link.delay = matched->design.delay;
    link.operating.ber_theory = matched->ber;
    if (fidelity_of(s.simulation) == Fidelity::decision)
      link.decisions = make_decision_link(link, matched->output);
    else if (std::isfinite(matched->ber))
      link.operating.ber_sampled =
          sampled_ber(link.chain, matched->design, link.device_baud, link.bytes);
    if (method_of(s.simulation) == Method::importance)
      link.importance = make_importance_link(matched->output);
  } else if (method_of(s.simulation) == Method::importance) {
    link.importance = make_importance_link(link);
  }
  return link;
}

}  // namespace sim
