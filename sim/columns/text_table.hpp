#pragma once
// Tables whose lines can be printed one by one: columns of a width known before their values are.
#include <array>
#include <string>
#include <vector>

#include "sim/scenario/axis.hpp"

namespace sim {

struct TextColumn {
  std::array<std::string, 3> names;  // the header, from top to bottom
  int width;                         // negative: to the left, as in printf
};

constexpr int number_width = 10;  // "-1.234e-09"

/// A column for each axis, wide enough for all its values.
std::vector<TextColumn> axis_columns(const std::vector<Axis>& axes);

/// The texts of a point's coordinates, one an axis.
std::vector<std::string> coordinate_texts(const std::vector<Axis>& axes,
                                          const std::vector<double>& coordinates);

/// One line, ended by a newline; a text a column.
std::string table_line(const std::vector<TextColumn>& columns,
                       const std::vector<std::string>& texts);

/// A whole table, whose columns to the left are as wide as their texts.
std::string text_table(std::vector<TextColumn> columns,
                       const std::vector<std::vector<std::string>>& rows);

/// So wide are lines of these columns at least.
int line_width(const std::vector<TextColumn>& columns);

/// "bit errors": a column's names in one line, without units.
std::string column_words(const TextColumn& column);

/// The lines of names, without those above all that are empty.
std::string table_head(const std::vector<TextColumn>& columns);

}  // namespace sim
