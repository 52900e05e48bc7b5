#pragma once
// Curves of a dataset: a variable over the swept number with the most values, or over a dimension
// of its own.
#include <optional>
#include <string>
#include <vector>

#include "sim/picture/chart.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

/// Its interval is in the variables NAME_ci_low and NAME_ci_high, where there are such.
struct DrawnVariable {
  std::string name;
  std::string title, label;  // of the chart, and along its axis
  bool logarithmic = false;
  std::string theory{};  // a variable of the same shape, drawn dashed; empty: none
};

/// The swept number with the most values; null where none was swept.
const Axis* widest_axis(const Dataset& data);

/// Over the widest axis a curve for each combination of the other axes' values and of the
/// variable's dimensions. Nothing where no number was swept, or the dataset has no such variable.
std::optional<Chart> swept_chart(const Dataset& data, const DrawnVariable& drawn);

/// Over the variable's one dimension, of numbers, a curve a point. Nothing where there is no such
/// variable.
std::optional<Chart> dimension_chart(const Dataset& data, const DrawnVariable& drawn);

}  // namespace sim
