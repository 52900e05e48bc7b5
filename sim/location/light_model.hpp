#pragma once
// What a device at a place gives a receiver: the light of channel/geometry, direct, mirrored and
// scattered by the floor, as a function of the place alone. Rays cost a microsecond; what the floor
// scatters costs milliseconds, is a hundredth of it at a metre and varies slowly, so that fits take
// it as linear around a place.
#include <vector>

#include "channel/geometry.hpp"

namespace sim {

struct Position {
  double x = 0, y = 0;  // m
};

double distance(const Position& a, const Position& b);

/// The device: one LED on a floor, and how receivers see it.
struct LightModel {
  channel::EmitterData emitter;
  dsp::WattsPerSteradian axial;  // radiant intensity on axis
  double led_celsius = channel::emitter_reference_celsius;
  double led_height_m = 0.01;
  bool all_round = true;  // as bright to all sides, as with a ring of LEDs: `yaw` means nothing
  dsp::Radians yaw, elevation;
  channel::Directivity directivity;  // of all receivers
  channel::Floor floor;
};

/// What one receiver measured, and where it stood. A robot that turns gives one a heading.
struct Reading {
  channel::Pose receiver;          // its heading is the yaw
  double irradiance_w_per_m2 = 0;  // effective, of the lit carrier, ambient light taken off
  double deviation_w_per_m2 = 0;   // its standard deviation, above 0
  /// Direction to the device from the heading, anticlockwise, with its standard deviation. A
  /// deviation of 0: none was measured.
  dsp::Radians bearing, bearing_deviation;

  Position place() const { return {receiver.x, receiver.y}; }
  bool has_bearing() const { return bearing_deviation.value > 0; }
};

/// Irradiance in W/m2 by the direct ray and its mirror image. The device must not stand at the
/// receiver.
double ray_light(const LightModel& model, const Position& device, const channel::Pose& receiver);

/// All of it.
double received_light(const LightModel& model, const Position& device,
                      const channel::Pose& receiver);

/// Scattered light at each reading's receiver, linear around a place; all 0 of a floor that
/// scatters none.
struct ScatteredLight {
  struct Linear {
    double value = 0, by_x = 0, by_y = 0;  // W/m2, and by metres
  };
  Position around;
  std::vector<Linear> at;  // a reading each

  double of(std::size_t reading, const Position& device) const;
};

ScatteredLight scattered_light(const LightModel& model, const std::vector<Reading>& readings,
                               const Position& around);

}  // namespace sim
