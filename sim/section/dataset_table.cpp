#include "sim/section/dataset_table.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "sim/columns/page_heading.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/section/dataset_cells.hpp"
#include "sim/section/swept_curves.hpp"

namespace sim {
namespace {

PageTable empty_table(const Dataset& data, const Dataset::Variable& first,
                      const std::vector<DatasetColumn>& columns) {
  PageTable table;
  for (const Axis& axis : data.axes) table.head.push_back(axis_name(axis));
  for (const std::string& dimension : first.dimensions) table.head.push_back(dimension);
  for (const DatasetColumn& column : columns) table.head.push_back(column.head);
  return table;
}

/// The elements of a variable's dimensions at its cell `i` of a point.
std::vector<std::string> elements_at(const Dataset& data, const Dataset::Variable& variable,
                                     std::size_t i) {
  std::vector<std::string> texts;
  std::size_t each = cells_a_point(data, variable);  // cells of an element
  for (const std::string& name : variable.dimensions) {
    const Dataset::Dimension& dimension = dimension_named(data, name);
    each /= dimension.size();
    texts.push_back(value_text(dimension, i / each % dimension.size()));
  }
  return texts;
}

/// Counts of 0 are what a device has at points where it is not.
bool is_known(const DatasetCells& cells, std::size_t i) {
  return std::isfinite(cells[i]) && cells[i] != 0;
}

}  // namespace

DatasetColumn headed_column(const Dataset& data, const ColumnFacts& column) {
  DatasetColumn headed{column.facts.name, page_heading(column)};
  if (column.real_text)
    headed.words = [text = column.real_text, cells = DatasetCells(data, column.facts.name)](
                       std::size_t cell) { return text(cells[cell]); };
  return headed;
}

std::vector<DatasetColumn> headed_columns(const Dataset& data,
                                          const std::vector<ColumnFacts>& columns,
                                          const std::vector<std::string>& names) {
  const auto column_of = [&](std::string_view name) {
    const auto found =
        std::ranges::find(columns, name, [](const ColumnFacts& c) { return c.facts.name; });
    return found == columns.end() ? nullptr : &*found;
  };
  std::vector<DatasetColumn> headed;
  for (const std::string& name : names)
    if (const ColumnFacts* column = column_of(name))
      headed.push_back(headed_column(data, *column));
    else if (const ColumnFacts* of_each = column_of(name_of_each(name)))
      headed.push_back({name, page_heading(*of_each)});
    else
      headed.push_back({name, name_in_words(name)});
  return headed;
}

std::optional<PageTable> dataset_table(const Dataset& data, std::vector<DatasetColumn> columns) {
  std::erase_if(columns, [&](const DatasetColumn& column) {
    return find_variable(data, column.name) == nullptr;
  });
  if (columns.empty()) return std::nullopt;
  const Dataset::Variable& first = *find_variable(data, columns.front().name);
  PageTable table = empty_table(data, first, columns);
  std::vector<DatasetCells> cells;
  for (const DatasetColumn& column : columns) cells.emplace_back(data, column.name);
  const std::size_t each = cells_a_point(data, first);
  for (std::size_t i = 0; i < each * count_points(data.axes); ++i) {
    if (std::ranges::none_of(cells, [&](const DatasetCells& c) { return is_known(c, i); }))
      continue;
    std::vector<std::string> row =
        coordinate_texts(data.axes, point_coordinates(data.axes, i / each));
    std::ranges::move(elements_at(data, first, i % each), std::back_inserter(row));
    for (std::size_t c = 0; c < columns.size(); ++c)
      row.push_back(columns[c].words ? columns[c].words(i) : cells[c].text(i));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace sim
