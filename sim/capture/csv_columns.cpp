#include "sim/capture/csv_columns.hpp"

#include <cmath>
#include <string>

#include "sim/text/letters.hpp"

namespace sim {
namespace {

bool has_time_heading(const Heading& heading) {
  const std::string name = in_lower_case(heading.name);
  return name.starts_with("time") || name == "t" || name == "x" || name == "x-axis" ||
         (name.empty() && time_unit(heading.unit));
}

}  // namespace

bool is_logic(const CsvTable& table, std::size_t column) {
  for (std::size_t row = 0; row < table.rows_ahead(); ++row) {
    const double cell = table.ahead(row, column);
    if (cell != 0 && cell != 1 && !std::isnan(cell)) return false;
  }
  return true;
}

std::optional<bool> level_in(double cell) {
  return std::isnan(cell) ? std::nullopt : std::optional(cell == 1);
}

std::optional<std::uint64_t> edges_of(const CsvTable& table, std::size_t column) {
  if (!is_logic(table, column)) return std::nullopt;
  std::uint64_t edges = 0;
  std::optional<bool> last;
  for (std::size_t row = 0; row < table.rows_ahead(); ++row) {
    const auto level = level_in(table.ahead(row, column));
    edges += last && level && last != level;
    if (level) last = level;
  }
  return edges;
}

bool is_constant(const CsvTable& table, std::size_t column) {
  std::optional<double> first;
  for (std::size_t row = 0; row < table.rows_ahead(); ++row) {
    const double cell = table.ahead(row, column);
    if (std::isnan(cell)) continue;
    if (first.value_or(cell) != cell) return false;
    first = cell;
  }
  return true;
}

bool rises(const CsvTable& table, std::size_t column) {
  const std::size_t rows = table.rows_ahead();
  for (std::size_t row = 1; row < rows; ++row)
    if (!(table.ahead(row, column) >= table.ahead(row - 1, column))) return false;
  return table.ahead(rows - 1, column) > table.ahead(0, column);
}

bool counts_rows(const Heading& heading) {
  const std::string name = in_lower_case(heading.name);
  return name == "index" || name == "sample" || name == "samples" || name == "sample #" ||
         name == "n" || name == "no" || name == "#" || name == "point";
}

std::optional<std::size_t> time_column(const CsvTable& table) {
  const std::size_t count = table.columns().size();
  for (std::size_t i = 0; i < count; ++i)
    if (has_time_heading(table.columns()[i]) && count > 1) return i;
  for (std::size_t i = 0; i < count && count > 1; ++i)
    if (!counts_rows(table.columns()[i]) && !is_logic(table, i) && rises(table, i)) return i;
  return std::nullopt;
}

}  // namespace sim
