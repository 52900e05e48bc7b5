#pragma once
// Least squares by damped Gauss-Newton steps: each is halved until chi-square falls. Nocedal &
// Wright, Numerical Optimization (2006), section 10.3.
#include <vector>

#include "sim/location/misfit.hpp"

namespace sim {

/// Where a device may be, in metres.
struct Area {
  double x_min = 0, x_max = 0, y_min = 0, y_max = 0;
  bool contains(const Position& p) const;
};

struct LeastSquares {
  const LightModel& model;
  const std::vector<Reading>& readings;
  Area area;
  bool intensity_unknown = false;
  /// Each deviation is a share of the light itself, and known of the reading alone: what is likely
  /// then hangs on how much light there is. Least squares take the deviations as they are.
  bool deviations_are_shares = false;
};

/// No position is nearer to a receiver: there LED and lens are no points to each other.
inline constexpr double least_distance_m = 0.05;

struct Minimum {
  Unknowns at;
  double chi_square = 0;
  bool converged = false;  // false: stopped at the area's edge or after many steps
};

/// Descends from a start inside of the area.
Minimum descend(const LeastSquares& problem, const ScatteredLight& scattered,
                const Unknowns& start);

}  // namespace sim
