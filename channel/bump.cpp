#include "channel/bump.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace channel {
namespace {

double shadow_length(double bump, double eye, double distance) {
  return eye > bump ? bump * distance / (eye - bump) : std::numeric_limits<double>::infinity();
}

}  // namespace

bool Bump::hides(const Point& from, const Point& to) const {
  if (height <= 0) return false;
  const double t_from = ahead.dot(foot_of(from) - place);
  const double t_to = ahead.dot(foot_of(to) - place);
  if ((t_from < 0) == (t_to < 0)) return false;
  return std::abs(std::lerp(from.z(), to.z(), t_from / (t_from - t_to))) <= height;
}

Interval Bump::shadow(const Foot& start, const Foot& direction, double reach) const {
  if (height <= 0) return {reach, reach};
  const double t = ahead.dot(start - place), slope = ahead.dot(direction);
  const auto [begin, end] = std::minmax({(-before - t) / slope, (behind - t) / slope});
  return {std::clamp(begin, 0.0, reach), std::clamp(end, 0.0, reach)};
}

Bump bump_between(const Floor& floor, const Point& led, const Point& receiver) {
  const Foot gap = foot_of(receiver) - foot_of(led);
  const double distance = gap.norm(), height = floor.bump_height_mm * 1e-3;
  if (distance == 0 || height <= 0) return {};
  const double share = floor.bump_position;
  return {.place = foot_of(led) + share * gap,
          .ahead = gap / distance,
          .height = height,
          .behind = shadow_length(height, led.z(), share * distance),
          .before = shadow_length(height, receiver.z(), (1 - share) * distance)};
}

}  // namespace channel
