#pragma once
// Curves of a dataset: a variable over the swept number with the most values, or over a dimension
// of its own.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/picture/chart.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

/// Its interval is in the variables NAME_ci_low and NAME_ci_high, where there are such.
struct DrawnVariable {
  std::string name;
  DrawnColumn how;
};

/// The columns that have a drawing, as variables.
template <class Point>
std::vector<DrawnVariable> drawn_columns(const Columns<Point>& columns) {
  std::vector<DrawnVariable> drawn;
  for (const Column<Point>& column : columns.all())
    if (column.is_stored() && column.drawing) drawn.push_back({column.facts.name, *column.drawing});
  return drawn;
}

/// The one of that name, which is among them.
template <class Point>
DrawnVariable drawn_column(const Columns<Point>& columns, const std::string& name) {
  const std::vector<DrawnVariable> drawn = drawn_columns(columns);
  return *std::ranges::find(drawn, name, &DrawnVariable::name);
}

/// The swept number with the most values; null where none was swept.
const Axis* widest_axis(const Dataset& data);

/// Over the widest axis a curve for each combination of the other axes' values and of the
/// variable's dimensions. Nothing where no number was swept, or the dataset has no such variable.
std::optional<Chart> swept_chart(const Dataset& data, const DrawnVariable& drawn);

/// Over the variable's one dimension, of numbers, a curve a point. Nothing where there is no such
/// variable.
std::optional<Chart> dimension_chart(const Dataset& data, const DrawnVariable& drawn);

}  // namespace sim
