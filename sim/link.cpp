#include "sim/link.hpp"

#include <xxhash.h>

#include <cmath>
#include <numbers>

#include "channel/emitter.hpp"
#include "channel/noise.hpp"
#include "protocol/cosys.hpp"
#include "sim/canonical_text.hpp"

namespace sim {
namespace {

using std::numbers::pi;

dsp::Hertz off_by(double nominal_hz, double ppm) {
  return dsp::Hertz(nominal_hz * (1 + ppm * 1e-6));
}

double in_db(double power_ratio) { return 10 * std::log10(power_ratio); }

/// |H| of the band-pass at `f`: the formula of channel/band_pass.hpp (Vishay 82459 rev 1.8 Fig. 5).
double band_pass_gain(const channel::ModuleData& module, dsp::Hertz f) {
  const double ratio = f.value / module.centre_hz;
  return 1 / std::hypot(1.0, module.q * (ratio - 1 / ratio));
}

channel::LightSettings light_settings(const Scenario& s) {
  return {.signal = light_of(s).total(),
          .ambient = dsp::WattsPerSquareMetre(s.ambient.irradiance_w_per_m2),
          .carrier = off_by(s.device.carrier_hz, s.device.carrier_error_ppm),
          .duty = s.device.carrier_duty,
          .noise_scale = s.noise.scale};
}

/// Signal: the carrier's fundamental. Noise: what shot and thermal noise put into the module with
/// the carrier on. SNR is taken behind the band-pass; Eb/N0 at the input, half of the bits being
/// light (average-energy convention: coherent OOK has BER = Q(sqrt(Eb/N0))).
OperatingPoint operating_point(const Scenario& s, const channel::LightSettings& light) {
  const double amplitude =
      channel::photocurrent(s.module, light.signal).value * 2 / pi * std::sin(pi * light.duty);
  const auto mean = channel::photocurrent(s.module, light.ambient + light.signal * light.duty);
  const double density =
      channel::noise_density(s.module, mean) * light.noise_scale * light.noise_scale;
  const dsp::Hertz bandwidth = channel::noise_bandwidth(s.module);
  const double power = amplitude * amplitude / 2;
  const double gain = band_pass_gain(s.module, light.carrier);
  return {.irradiance_mw_per_m2 = light.signal.value * 1e3,
          .ambient_w_per_m2 = light.ambient.value,
          .snr_db = in_db(power * gain * gain / (density * bandwidth.value)),
          .snr_bandwidth_hz = bandwidth.value,
          .ebn0_db = in_db(power / 2 / s.device.baud / density)};
}

std::uint32_t point_hash(const Scenario& scenario) {
  const std::string text = canonical_text(scenario);
  return XXH32(text.data(), text.size(), 0);
}

}  // namespace

channel::ReceivedLight light_of(const Scenario& s) {
  const channel::Pose led{.z = s.led.height_mm * 1e-3,
                          .yaw = dsp::degrees(s.led.yaw_deg),
                          .elevation = dsp::degrees(s.led.elevation_deg)};
  const channel::Pose receiver =
      channel::receiver_pose(dsp::Metres(s.receiver.range_m), dsp::degrees(s.receiver.bearing_deg),
                             dsp::Metres(s.receiver.height_mm * 1e-3),
                             dsp::degrees(s.receiver.yaw_deg), dsp::degrees(s.receiver.tilt_deg));
  const auto axial = channel::axial_intensity(s.emitter, dsp::Amperes(s.led.current_ma * 1e-3));
  const channel::Directivity directivity{.relative_distance = s.module.directivity};
  return channel::received_light(s.emitter, axial, led, directivity, receiver, s.floor);
}

Link make_link(const Scenario& s) {
  const channel::LightSettings light = light_settings(s);
  Link link;
  link.message = s.device.message;
  link.bytes = protocol::cosys_encode(s.device.message);
  link.device_baud = off_by(s.device.baud, s.device.clock_error_ppm);
  link.start_jitter = dsp::Seconds(s.device.start_jitter_us * 1e-6);
  link.interval_min = dsp::Seconds(s.device.interval_min_ms * 1e-3);
  link.interval_max = dsp::Seconds(s.device.interval_max_ms * 1e-3);
  link.warmup_messages = static_cast<int>(s.simulation.warmup_messages);
  link.chain = channel::design_chain(s.module, light, dsp::Hertz(s.simulation.sample_rate_hz));
  link.delay = channel::nominal_delay(s.module);
  link.receiver_baud = off_by(s.device.baud, s.uart.clock_error_ppm);
  link.uart = protocol::find_uart_receiver(s.uart.receiver);
  link.seed = static_cast<std::uint64_t>(s.simulation.seed);
  link.point = point_hash(s);
  link.operating = operating_point(s, light);
  return link;
}

}  // namespace sim
