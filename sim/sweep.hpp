#pragma once
// Sweep: ranges and lists as users write them ("1:0.5:20", "1,2,5"), made into axes, and the grid
// that several axes span. Row-major: the last axis varies fastest.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/axis.hpp"
#include "sim/keys.hpp"

namespace sim {

constexpr std::size_t most_points = 1'000'000;

/// The whole text as a finite or infinite number, blanks around it aside.
std::optional<double> parse_number(std::string_view text);

/// Whether a text is written as a range or list rather than as one value.
bool is_range_or_list(std::string_view text);

/// Values of "a", "a:step:b" (b included within rounding) or "a,b,c". A range gives the same
/// numbers as its values typed out: 0.1:0.1:0.3 ends at 0.3 exactly. `problem` opens the error
/// line.
std::vector<double> parse_values(std::string_view text, const std::string& problem);

/// The axis of a numeric key: at least one value, each in range and none twice.
Axis make_axis(const Key& key, std::vector<double> values, const std::string& place);

/// Number of points of the grid; throws beyond most_points. No axes: one point.
std::size_t count_points(const std::vector<Axis>& axes);

/// Coordinates of point `index`, one value an axis.
std::vector<double> point_coordinates(const std::vector<Axis>& axes, std::size_t index);

}  // namespace sim
