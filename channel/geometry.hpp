#pragma once
// Where LED and receiver are and where they look, and what light gets from one to the other:
// the direct ray, the floor's mirror image of it and the floor's diffuse part.
// Axes: x, y on the floor, z up, in metres; yaw from +x towards +y, elevation from the floor up.
#include "channel/emitter.hpp"
#include "channel/floor.hpp"
#include "dsp/units.hpp"

namespace channel {

struct Pose {
  double x = 0, y = 0, z = 0;  // m
  dsp::Radians yaw;
  dsp::Radians elevation;
};

/// A receiver placed as scenarios say it: at `range` along the floor and `bearing` from an LED that
/// stands at the origin; `yaw` and `tilt` turn it away from looking straight at the LED's foot.
Pose receiver_pose(dsp::Metres range, dsp::Radians bearing, dsp::Metres height, dsp::Radians yaw,
                   dsp::Radians tilt);

/// What the receiver makes of a ray that arrives `off_axis`: 1 on axis, 0 beyond 90 degrees.
/// Includes the cosine. Vishay plots it as relative *distance* (82459 rev 1.8 Fig. 11); the
/// response to irradiance is its square. An empty table means cos^n.
struct Directivity {
  Curve relative_distance{};  // against degrees off axis, 0..90, in the plane of the floor
  Curve vertical{};           // the same from below, -90, to above, 90; empty: as in that plane
  double cosine_power = 1.0;  // n, used where the first table is empty
  /// `upward`: sine of the angle around the axis, from the plane of the floor (0) to straight above
  /// (1) or below (-1). Between the planes distances are weighted with its square.
  double operator()(dsp::Radians off_axis, double upward = 0) const;
};

/// Effective irradiance at the receiver (peak of the on/off waveform), by path.
struct ReceivedLight {
  dsp::WattsPerSquareMetre direct, specular, diffuse;
  dsp::WattsPerSquareMetre total() const { return direct + specular + diffuse; }
};

/// Light of an LED of axial intensity `axial` at the receiver. Paths add incoherently: the path
/// difference exceeds the coherence length of a 30 nm wide LED (29 um) up to about 7 m. Rays that
/// meet the floor's bump, at its top too, are lost on each path.
/// LED and receiver must not be below the floor nor at the same point. The LED's temperature only
/// decides the wavelength here: `axial` is taken as it is.
ReceivedLight received_light(const EmitterData& emitter, dsp::WattsPerSteradian axial,
                             const Pose& led, const Directivity& directivity, const Pose& receiver,
                             const Floor& floor, double led_celsius = emitter_reference_celsius);

/// Light of the LED that meets the floor, in watts, by the same patches as the diffuse part. The
/// LED must be above the floor.
double flux_onto_floor(const EmitterData& emitter, dsp::WattsPerSteradian axial, const Pose& led);

}  // namespace channel
