#pragma once
// An axis of a sweep, and places along it, as every --json writes them.
#include <nlohmann/json_fwd.hpp>

#include "sim/scenario/axis.hpp"

namespace sim {

/// {"key", "unit", "long_name", "values"}: values are numbers, or texts of a text axis.
nlohmann::ordered_json json_axis(const Axis& axis);

/// A number, or the text of a text axis.
nlohmann::ordered_json json_coordinate(const Axis& axis, double coordinate);

/// An end of an interval; JSON has no infinity, so that is null.
nlohmann::ordered_json json_end(double end);

}  // namespace sim
