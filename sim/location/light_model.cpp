#include "sim/location/light_model.hpp"

#include <cmath>

namespace sim {
namespace {

channel::ReceivedLight light(const LightModel& model, const channel::Floor& floor,
                             const Position& device, const channel::Pose& receiver) {
  const double towards = std::atan2(receiver.y - device.y, receiver.x - device.x);
  const channel::Pose led{.x = device.x,
                          .y = device.y,
                          .z = model.led_height_m,
                          .yaw = model.all_round ? dsp::Radians(towards) : model.yaw,
                          .elevation = model.elevation};
  return channel::received_light(model.emitter, model.axial, led, model.directivity, receiver,
                                 floor, model.led_celsius);
}

double scattered(const LightModel& model, const Position& device, const channel::Pose& receiver) {
  return light(model, model.floor, device, receiver).diffuse.value;
}

/// Far enough apart that the patches of channel/geometry, a few parts in a thousand of the
/// scattered light, do not show in the difference.
constexpr double scattered_step = 0.02;  // of the distance

ScatteredLight::Linear linear(const LightModel& model, const Position& device,
                              const channel::Pose& receiver) {
  const double h = scattered_step * distance(device, {receiver.x, receiver.y});
  const auto at = [&](double dx, double dy) {
    return scattered(model, {device.x + dx, device.y + dy}, receiver);
  };
  return {.value = at(0, 0),
          .by_x = (at(h, 0) - at(-h, 0)) / (2 * h),
          .by_y = (at(0, h) - at(0, -h)) / (2 * h)};
}

}  // namespace

double distance(const Position& a, const Position& b) { return std::hypot(a.x - b.x, a.y - b.y); }

double ray_light(const LightModel& model, const Position& device, const channel::Pose& receiver) {
  channel::Floor mirror = model.floor;
  mirror.diffuse_reflectance = 0;
  return light(model, mirror, device, receiver).total().value;
}

double received_light(const LightModel& model, const Position& device,
                      const channel::Pose& receiver) {
  return light(model, model.floor, device, receiver).total().value;
}

double ScatteredLight::of(std::size_t reading, const Position& device) const {
  const Linear& part = at[reading];
  return part.value + part.by_x * (device.x - around.x) + part.by_y * (device.y - around.y);
}

ScatteredLight scattered_light(const LightModel& model, const std::vector<Reading>& readings,
                               const Position& around) {
  ScatteredLight all{around, std::vector<ScatteredLight::Linear>(readings.size())};
  if (model.floor.diffuse_reflectance <= 0) return all;
  for (std::size_t i = 0; i < readings.size(); ++i)
    all.at[i] = linear(model, around, readings[i].receiver);
  return all;
}

}  // namespace sim
