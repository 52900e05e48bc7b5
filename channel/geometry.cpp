#include "channel/geometry.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "channel/bump.hpp"

namespace channel {
namespace {

using std::numbers::pi;

struct Placed {  // a pose as vectors
  Point position;
  Point axis, up;  // unit length, at right angles

  Foot foot() const { return foot_of(position); }
  double height() const { return position.z(); }
};

Placed placed(const Pose& pose) {
  const double along = std::cos(pose.elevation.value), up = std::sin(pose.elevation.value);
  const Point level(std::cos(pose.yaw.value), std::sin(pose.yaw.value), 0);
  return {.position = {pose.x, pose.y, pose.z},
          .axis = along * level + up * Point::UnitZ(),
          .up = along * Point::UnitZ() - up * level};
}

Placed mirrored(Placed end) {
  for (Point* each : {&end.position, &end.axis, &end.up}) each->z() *= -1;
  return end;
}

dsp::Radians angle_between(const Point& axis, const Point& ray, double length) {
  return dsp::Radians(std::acos(std::clamp(axis.dot(ray) / length, -1.0, 1.0)));
}

struct Link {
  const EmitterData& emitter;
  const Directivity& directivity;
  Placed led, receiver;
  dsp::Metres wavelength;
  Bump bump;

  double emitted(const Placed& from, const Point& ray, double length) const {
    return relative_intensity(emitter, angle_between(from.axis, ray, length));
  }
  double accepted(const Point& ray, double length) const {
    const dsp::Radians off_axis = angle_between(receiver.axis, -ray, length);
    const double aside = length * std::sin(off_axis.value);
    return directivity(off_axis, aside > 0 ? -ray.dot(receiver.up) / aside : 0);
  }
};

// The gains below are irradiance at the receiver per axial intensity, 1/m2.
double ray_gain(const Link& link, const Placed& from) {
  const Point ray = link.receiver.position - from.position;
  const double length = ray.norm();
  assert(length > 0);
  if (link.bump.hides(from.position, link.receiver.position)) return 0;
  return link.emitted(from, ray, length) * link.accepted(ray, length) / (length * length);
}

double specular_gain(const Link& link, const Floor& floor) {
  const Placed image = mirrored(link.led);
  const Point ray = link.receiver.position - image.position;
  return ray_gain(link, image) * mirrored_share(floor, ray.z() / ray.norm(), link.wavelength);
}

// Patches lie on rays from a foot, at radii scale * sinh(u) in even steps of u: as fine as `scale`
// near the foot, in proportion to the radius far from it. Against an eight times finer grid the
// diffuse part is within 0.3 % for beams of 10 degrees to half intensity and wider; within 1.2 %
// for 3 degrees, unless such a beam falls straight on the LED's own foot (a quarter too much).
constexpr int rays = 72;
constexpr double radial_step = 0.1;

struct Sector {  // the half of the floor on one foot's side of the bisector between two feet
  Foot foot;
  Foot towards;  // unit vector to the other foot
  double split;  // distance of the bisector; infinite: the whole floor
  double scale;
  double reach;
  Bump bump = {};
};

template <class Density>
double integrate_ray(const Foot& foot, const Foot& direction, double scale, const Interval& radii,
                     const Density& density) {
  if (radii.end <= radii.begin) return 0;
  const double begin = std::asinh(radii.begin / scale), end = std::asinh(radii.end / scale);
  const double steps = std::ceil((end - begin) / radial_step);
  const double du = (end - begin) / steps;
  double sum = 0;
  for (double k = 0; k < steps; ++k) {
    const double r = scale * std::sinh(begin + (k + 0.5) * du);
    // The midpoint rule overrates the kink at the foot by a twelfth of the first step (Euler and
    // Maclaurin's first term), which matters where a narrow beam falls on it.
    const double weight = k == 0 && begin == 0 ? 11.0 / 12.0 : 1.0;
    sum += weight * density(Foot(foot + r * direction)) * r * std::hypot(r, scale);
  }
  return sum * du;
}

// Midpoint rule over the sector; density per floor area. The edges at right angles to `towards`,
// where the sector's reach jumps, fall between rays.
template <class Density>
double integrate(const Sector& sector, const Density& density) {
  static_assert(rays % 4 == 0);
  const Foot across(-sector.towards.y(), sector.towards.x());
  double sum = 0;
  for (int i = 0; i < rays; ++i) {
    const double phi = (i + 0.5) * 2 * pi / rays;
    const Foot direction = std::cos(phi) * sector.towards + std::sin(phi) * across;
    const double ahead = std::cos(phi);
    const double reach = ahead > 0 ? std::min(sector.reach, sector.split / ahead) : sector.reach;
    const Interval dark = sector.bump.shadow(sector.foot, direction, reach);
    for (const Interval& lit : {Interval{0, dark.begin}, Interval{dark.end, reach}})
      sum += integrate_ray(sector.foot, direction, sector.scale, lit, density);
  }
  return sum * 2 * pi / rays;
}

// Light that a patch at `at` takes from the LED and passes on, per area and axial intensity.
double scattered(const Link& link, const Floor& floor, const Foot& at) {
  const Point patch(at.x(), at.y(), 0);
  const Point in = patch - link.led.position;
  const double in_length = in.norm();
  const double emitted = link.emitted(link.led, in, in_length);
  if (emitted <= 0) return 0;
  const Point out = link.receiver.position - patch;
  const double out_length = out.norm();
  const double accepted = link.accepted(out, out_length);
  if (accepted <= 0) return 0;
  const double sin_in = -in.z() / in_length;
  const double sin_out = out.z() / out_length;
  return emitted * sin_in / (in_length * in_length) * accepted * sin_out /
         (out_length * out_length) * diffuse_brdf(floor, sin_in, sin_out, link.wavelength);
}

double diffuse_gain(const Link& link, const Floor& floor) {
  const double lower = std::min(link.led.height(), link.receiver.height());
  if (floor.diffuse_reflectance <= 0 || lower <= 0) return 0;
  const Foot gap = link.receiver.foot() - link.led.foot();
  const double distance = gap.norm();
  const Foot towards = distance > 0 ? Foot(gap / distance) : Foot::UnitX();
  // Far out the density falls as r^-6: beyond this reach less than 1e-4 of it is left.
  const double reach = 30 * (distance + link.led.height() + link.receiver.height());
  const auto density = [&](const Foot& at) { return scattered(link, floor, at); };
  return integrate({link.led.foot(), towards, distance / 2, lower, reach, link.bump}, density) +
         integrate({link.receiver.foot(), -towards, distance / 2, lower, reach, link.bump},
                   density);
}

}  // namespace

Pose receiver_pose(dsp::Metres range, dsp::Radians bearing, dsp::Metres height, dsp::Radians yaw,
                   dsp::Radians tilt) {
  return {.x = range.value * std::cos(bearing.value),
          .y = range.value * std::sin(bearing.value),
          .z = height.value,
          .yaw = bearing + dsp::Radians(pi) + yaw,
          .elevation = tilt};
}

double Directivity::operator()(dsp::Radians off_axis, double upward) const {
  if (off_axis.value > pi / 2) return 0;
  if (relative_distance.empty()) return std::pow(std::cos(off_axis.value), cosine_power);
  const double degrees = dsp::in_degrees(off_axis);
  const double level = relative_distance(degrees);
  if (vertical.empty()) return level * level;
  const double steep = vertical(std::copysign(degrees, upward)) / vertical(0);
  const double distance = std::lerp(level, steep, std::min(upward * upward, 1.0));
  return distance * distance;
}

ReceivedLight received_light(const EmitterData& emitter, dsp::WattsPerSteradian axial,
                             const Pose& led, const Directivity& directivity, const Pose& receiver,
                             const Floor& floor, double led_celsius) {
  assert(led.z >= 0 && receiver.z >= 0);
  const Placed from = placed(led), to = placed(receiver);
  const Link link{emitter,
                  directivity,
                  from,
                  to,
                  wavelength(emitter, led_celsius),
                  bump_between(floor, from.position, to.position)};
  const auto irradiance = [&](double gain) { return dsp::WattsPerSquareMetre(axial.value * gain); };
  return {.direct = irradiance(ray_gain(link, link.led)),
          .specular = irradiance(specular_gain(link, floor)),
          .diffuse = irradiance(diffuse_gain(link, floor))};
}

double flux_onto_floor(const EmitterData& emitter, dsp::WattsPerSteradian axial, const Pose& led) {
  assert(led.z > 0);
  const Placed source = placed(led);
  const auto density = [&](const Foot& at) {
    const Point ray = Point(at.x(), at.y(), 0) - source.position;
    const double length = ray.norm();
    return relative_intensity(emitter, angle_between(source.axis, ray, length)) * -ray.z() /
           (length * length * length);
  };
  // The light that passes beyond this reach stays within 1e-4 rad of the horizon.
  const Sector whole{source.foot(), Foot::UnitX(), std::numeric_limits<double>::infinity(), led.z,
                     1e4 * led.z};
  return axial.value * integrate(whole, density);
}

}  // namespace channel
