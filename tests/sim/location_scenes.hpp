#pragma once
// Devices and receivers for tests of location.
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "sim/location/locate.hpp"

namespace sim {

/// 72.3 mW/sr to all sides, receivers that respond alike in front: E = A / d^2 without a floor.
inline LightModel inverse_square() {
  LightModel model;
  model.emitter.pattern = {{0, 90}, {1, 1}};
  model.axial = dsp::WattsPerSteradian(0.0723);
  model.directivity.cosine_power = 0;
  model.floor = {.refractive_index = 1};
  return model;
}

/// A photodiode of 65 degrees (Vishay 81521) on the default floor, one LED that shines along +x.
inline LightModel indoors() {
  LightModel model;
  model.emitter.half_angle_deg = 17;
  model.axial = dsp::WattsPerSteradian(0.0723);
  model.all_round = false;
  model.directivity.cosine_power = channel::cosine_power(dsp::degrees(65));
  model.floor = {.refractive_index = 1.5, .roughness_um = 5, .diffuse_reflectance = 0.3};
  return model;
}

inline channel::Pose receiver_at(double x, double y, double heading_deg) {
  return {.x = x, .y = y, .z = 0.01, .yaw = dsp::degrees(heading_deg), .elevation = {}};
}

inline Reading from(const channel::Pose& receiver) {
  Reading reading;
  reading.receiver = receiver;
  return reading;
}

/// What these receivers read of a device, with a deviation of a share of it.
inline std::vector<Reading> readings_of(const LightModel& model, const Position& device,
                                        const std::vector<channel::Pose>& receivers,
                                        double share = 0.01) {
  std::vector<Reading> readings;
  for (const channel::Pose& receiver : receivers) {
    Reading reading = from(receiver);
    reading.irradiance_w_per_m2 = received_light(model, device, receiver);
    reading.deviation_w_per_m2 = share * reading.irradiance_w_per_m2;
    readings.push_back(reading);
  }
  return readings;
}

/// Adds to each the direction to the device.
inline void add_bearings(std::vector<Reading>& readings, const Position& device, double sigma_deg) {
  for (Reading& reading : readings) {
    reading.bearing = {};
    reading.bearing = dsp::Radians(bearing_error(reading, device));
    reading.bearing_deviation = dsp::degrees(sigma_deg);
  }
}

/// Four receivers at the corners of a room of 3 m by 2 m, looking at its middle.
inline std::vector<channel::Pose> four_corners() {
  const double tilt = std::atan2(2, 3) * 180 / std::numbers::pi;
  return {receiver_at(0, 0, tilt), receiver_at(3, 0, 180 - tilt), receiver_at(3, 2, 180 + tilt),
          receiver_at(0, 2, -tilt)};
}

/// One robot that turns on the spot.
inline std::vector<channel::Pose> headings(double x, double y, const std::vector<double>& degrees) {
  std::vector<channel::Pose> poses;
  for (const double heading : degrees) poses.push_back(receiver_at(x, y, heading));
  return poses;
}

}  // namespace sim
