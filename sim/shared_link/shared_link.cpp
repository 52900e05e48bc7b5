#include "sim/shared_link/shared_link.hpp"

#include "channel/geometry.hpp"
#include "protocol/uart_receivers.hpp"
#include "sim/link/disturbance.hpp"
#include "sim/link/link.hpp"
#include "sim/link/validity.hpp"
#include "sim/shared_link/shared_link_keys.hpp"

namespace sim {
namespace {

/// What the floor gives back of an LED to the module beside it. What goes from one to the other
/// directly is kept away by their bodies. Along x is the line to the other node, from which both
/// are turned as those of a link are: the LED is at the link's one end, the module at the other.
dsp::WattsPerSquareMetre reflected_light(const Scenario& s) {
  const channel::Pose led{.z = s.led.height_mm * 1e-3,
                          .yaw = dsp::degrees(s.led.yaw_deg - s.receiver.bearing_deg),
                          .elevation = dsp::degrees(s.led.elevation_deg)};
  const channel::Pose module{.y = s.settings.of<SharedLinkSettings>().led_offset_mm * 1e-3,
                             .z = s.receiver.height_mm * 1e-3,
                             .yaw = dsp::degrees(s.receiver.yaw_deg),
                             .elevation = dsp::degrees(s.receiver.tilt_deg)};
  const auto axial = channel::axial_intensity(s.emitter, dsp::Amperes(s.led.current_ma * 1e-3),
                                              s.led.temperature_c);
  const channel::Directivity directivity{.relative_distance = s.module.directivity,
                                         .vertical = s.module.directivity_vertical};
  const auto light = channel::received_light(s.emitter, axial, led, directivity, module, s.floor,
                                             s.led.temperature_c);
  return light.specular + light.diffuse;
}

channel::Disturbance design_reflection(const Scenario& s, dsp::WattsPerSquareMetre peak,
                                       dsp::Hertz carrier) {
  return channel::design_keyed_light(peak, carrier, s.device.carrier_duty,
                                     dsp::Hertz(s.simulation.sample_rate_hz));
}

}  // namespace

SharedLinkSetup make_shared_link(const Scenario& scenario) {
  Scenario s = scenario;
  s.module = module_of(scenario);
  const dsp::Hertz rate(s.simulation.sample_rate_hz);
  const dsp::Hertz carrier(s.device.carrier_hz * (1 + s.device.carrier_error_ppm * 1e-6));
  const double colour = colour_response(s.module, s.emitter, s.led.temperature_c);
  const auto signal = light_of(s).total() * colour;
  const auto reflected =
      reflected_light(s) * (s.settings.of<SharedLinkSettings>().own_reflection * colour);
  SharedLinkSetup e{
      .settings = s.settings.of<SharedLinkSettings>(),
      .chain = channel::design_chain(s.module,
                                     {.signal = signal,
                                      .ambient = ambient_of(s),
                                      .carrier = carrier,
                                      .duty = s.device.carrier_duty,
                                      .noise_scale = s.noise.scale},
                                     rate),
      .disturbances = {},
      .baud = dsp::Hertz(s.device.baud * (1 + s.device.clock_error_ppm * 1e-6)),
      .receiver_baud = dsp::Hertz(s.device.baud * (1 + s.uart.clock_error_ppm * 1e-6)),
      .delay = channel::nominal_delay(s.module),
      .uart = protocol::find_uart_receiver(s.uart.receiver),
      .irradiance_mw_per_m2 = signal.value * 1e3,
      .reflected_mw_per_m2 = reflected.value * 1e3,
      .validity_flags =
          validity_flags_of(scenario, {.irradiance_mw_per_m2 = (signal + reflected).value * 1e3}),
      .seed = static_cast<std::uint64_t>(s.simulation.seed),
      .point = point_hash(scenario)};
  e.chain.disturbances.push_back(design_reflection(s, reflected, carrier));
  for (const auto& [name, disturbance] : s.disturbances) {
    e.disturbances.push_back(disturbance);
    e.chain.disturbances.push_back(design_disturbance(disturbance, rate));
  }
  return e;
}

}  // namespace sim
