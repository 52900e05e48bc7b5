#pragma once
// Sweep: values of keys made into axes, and the grid that several axes span. Row-major: the last
// axis varies fastest.
#include <cstddef>
#include <string>
#include <vector>

#include "sim/scenario/axis.hpp"
#include "sim/scenario/keys.hpp"

namespace sim {

/// The axis of a numeric key: at least one value, each in range and none twice.
Axis make_axis(const Key& key, std::vector<double> values, const std::string& place);

/// Number of points of the grid; throws beyond most_points. No axes: one point.
std::size_t count_points(const std::vector<Axis>& axes);

/// Coordinates of point `index`, one value an axis.
std::vector<double> point_coordinates(const std::vector<Axis>& axes, std::size_t index);

}  // namespace sim
