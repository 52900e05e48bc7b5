#pragma once
// How experiments say which of their points leave the range of a model (sim/link/validity).
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/result/dataset.hpp"

namespace sim {

inline constexpr const char* validity_flags_name = "outside_validity";

/// "! near", or nothing.
std::string validity_mark(std::uint64_t mask);

/// Their names, by the bits of the mask.
std::vector<std::string> validity_flag_names();

/// Adds the column of the points' masks, which each has as `validity_flags`.
template <class Point>
Column<Point>& add_validity_flags(Columns<Point>& columns) {
  return columns
      .flags(
          {validity_flags_name, "1", "models that are outside of their range"},
          [](const Point& point) { return point.validity_flags; }, validity_flag_names(),
          validity_mark)
      .headed({{"", "", ""}, -1})
      .spared_before(-1);
}

/// What the marks of all points mean, a line each.
std::string validity_notes(const Dataset& data);

inline constexpr const char* validity_words = "outside of what a model is valid for";

/// "Marked in the table of all numbers: of 5 points 2 with an alarm."; empty without marks.
std::string marked_line(std::size_t points, const std::vector<std::string>& marks);

}  // namespace sim
