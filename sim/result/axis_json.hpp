#pragma once
// An axis of a sweep as every --json writes it.
#include <nlohmann/json_fwd.hpp>

#include "sim/scenario/axis.hpp"

namespace sim {

/// {"key", "unit", "long_name", "values"}: values are numbers, or texts of a text axis.
nlohmann::ordered_json json_axis(const Axis& axis);

}  // namespace sim
