#pragma once
// LED, floor and receiver set up by a line each, for the tests of geometry.
#include <cmath>

#include "channel/geometry.hpp"

namespace channel {

inline constexpr dsp::WattsPerSteradian one_watt(1);
inline const Floor no_floor{.refractive_index = 1};
inline const Floor white{.refractive_index = 1, .diffuse_reflectance = 1};

inline EmitterData cosine_led(double m) {
  EmitterData led{"cosine", {{100}, {100}}, {}};
  for (int i = 0; i <= 900; ++i) {
    led.pattern.x.push_back(i * 0.1);
    led.pattern.y.push_back(std::pow(std::cos(dsp::degrees(i * 0.1).value), m));
  }
  return led;
}

inline Directivity cosine(double n) { return {.relative_distance = {}, .cosine_power = n}; }

inline Pose at(double x, double y, double z, double yaw_deg = 0, double elevation_deg = 0) {
  return {x, y, z, dsp::degrees(yaw_deg), dsp::degrees(elevation_deg)};
}

inline Pose facing(double d, double h) {  // a receiver at range d that looks back at the origin
  return receiver_pose(dsp::Metres(d), dsp::Radians(0), dsp::Metres(h), {}, {});
}

inline ReceivedLight level_link(double m, double n, double d, double h, const Floor& floor) {
  return received_light(cosine_led(m), one_watt, at(0, 0, h), cosine(n), facing(d, h), floor);
}

inline double diffuse_ratio(double m, double n, double d, double h) {
  const ReceivedLight light = level_link(m, n, d, h, white);
  return light.diffuse / light.direct;
}

}  // namespace channel
