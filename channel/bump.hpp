#pragma once
// For geometry.cpp. A bump of the floor: a thin wall across the line between LED and receiver, at
// right angles to it, without end to either side. It hides what it stands before; light does not
// bend around it.
#include <Eigen/Core>

#include "channel/floor.hpp"

namespace channel {

using Point = Eigen::Vector3d;  // m, as geometry.hpp's axes
using Foot = Eigen::Vector2d;   // a place on the floor

inline Foot foot_of(const Point& point) { return point.head<2>(); }

struct Interval {
  double begin, end;
};

struct Bump {
  Foot place = Foot::Zero();
  Foot ahead = Foot::Zero();  // unit vector from the LED's foot to the receiver's
  double height = 0;          // m; 0: none
  double behind = 0;          // m, how far its shadow of the LED reaches along `ahead`
  double before = 0;          // m, how far back the floor is hidden from the receiver

  /// Whether the ray meets it. A mirror image is as far below the floor as its object is above.
  bool hides(const Point& from, const Point& to) const;

  /// The part of a line over the floor, from 0 to `reach`, that LED or receiver does not see.
  Interval shadow(const Foot& start, const Foot& direction, double reach) const;
};

/// The floor's bump between the two; none where the receiver is right above or below the LED.
Bump bump_between(const Floor& floor, const Point& led, const Point& receiver);

}  // namespace channel
