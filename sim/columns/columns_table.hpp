#pragma once
// The columns of a result as a table in the terminal: a row for each point, or for each element
// that a point has of a dimension.
#include <cassert>
#include <cstddef>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// A column's cell as the table has it.
template <class Point>
std::string cell_text(const Column<Point>& column, const Point& point, std::size_t element = 0) {
  return std::visit(
      [&](const auto& kind) -> std::string {
        using Held = std::decay_t<decltype(kind)>;
        auto value = kind.read(point, element);
        if constexpr (std::is_same_v<Held, typename Column<Point>::Count>)
          return std::to_string(value);
        else if constexpr (std::is_same_v<Held, typename Column<Point>::Words>)
          return value;
        else if constexpr (std::is_same_v<Held, typename Column<Point>::Choice>)
          return value ? kind.names.at(*value) : "-";
        else if constexpr (std::is_same_v<Held, typename Column<Point>::Real>)
          return column.real_text(value);
        else
          return kind.text(value);
      },
      column.kind);
}

/// Rows for the points of a scenario, which can be printed while they are measured.
template <class Point>
class PointTable {
 public:
  /// `any`: one of the points, before its first run or after it. Where lines would be wider than
  /// `room` characters (0: none is too wide), columns are left out.
  PointTable(const Columns<Point>& columns, const LoadedScenario& scenario, const Point& any,
             int room = 0)
      : axes_(scenario.sweep), axis_headings_(axis_columns(axes_)) {
    std::vector<Column<Point>> spread_together;  // of one dimension, one behind the other
    const auto spread_them = [&] {
      if (!spread_together.empty())
        spread(spread_together,
               columns.dimension_of(spread_together.front().over.front()).labels(any));
      spread_together.clear();
    };
    for (const Column<Point>& column : columns.all()) {
      if (column.is_shown != nullptr && !column.is_shown(scenario)) continue;
      if (!spread_together.empty() &&
          (!column.spread || column.over != spread_together.front().over))
        spread_them();
      if (column.spread) {
        assert(column.over.size() == 1);
        spread_together.push_back(column);
      } else if (column.has_heading() && column.over.empty()) {
        add(column, 0, column.heading);
      }
    }
    spread_them();
    if (room > 0) leave_out(room);
  }

  /// Names of the columns that have no room.
  const std::vector<std::string>& left_out() const { return left_out_; }

  std::string head() const { return table_head(headings()); }
  std::string row(const Point& point) const {
    std::vector<std::string> texts = coordinate_texts(axes_, point.coordinates);
    for (const Cell& cell : cells_)
      texts.push_back(point.reached() || cell.column.is_known_before
                          ? cell_text(cell.column, point, cell.element)
                          : "-");
    return table_line(headings(), texts);
  }

 private:
  struct Cell {
    Column<Point> column;
    std::size_t element;
    TextColumn heading;
  };

  std::vector<TextColumn> headings() const {
    std::vector<TextColumn> all = axis_headings_;
    for (const Cell& cell : cells_) all.push_back(cell.heading);
    return all;
  }

  /// Of equals the last goes first.
  void leave_out(int room) {
    while (cells_.size() > 1 && line_width(headings()) > room) {
      auto spared = cells_.begin();
      for (auto cell = cells_.begin(); cell != cells_.end(); ++cell)
        if (cell->column.spared >= spared->column.spared) spared = cell;
      left_out_.push_back(column_words(spared->heading));
      cells_.erase(spared);
    }
  }

  /// Element by element, with all columns of each.
  void spread(const std::vector<Column<Point>>& together, const std::vector<Label>& labels) {
    for (std::size_t i = 0; i < labels.size(); ++i)
      for (const Column<Point>& column : together) add(column, i, column.spread(labels[i], i));
  }

  void add(const Column<Point>& column, std::size_t element, TextColumn heading) {
    cells_.push_back({column, element, std::move(heading)});
  }

  std::vector<Axis> axes_;
  std::vector<TextColumn> axis_headings_;
  std::vector<Cell> cells_;
  std::vector<std::string> left_out_;
};

/// The headed columns that have just this dimension: a row for each element that the point has.
template <class Point>
std::string element_table(const Columns<Point>& columns, const std::string& dimension,
                          const Point& point) {
  std::vector<TextColumn> headings;
  std::vector<std::vector<std::string>> rows(columns.dimension_of(dimension).labels(point).size());
  for (const Column<Point>& column : columns.all()) {
    if (!column.has_heading() || column.over != std::vector<std::string>{dimension}) continue;
    headings.push_back(column.heading);
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].push_back(cell_text(column, point, i));
  }
  return text_table(std::move(headings), rows);
}

/// The headed columns without dimensions: a row for each of `rows`.
template <class Row>
std::string row_table(const Columns<Row>& columns, const std::vector<Row>& rows) {
  std::vector<TextColumn> headings;
  std::vector<std::vector<std::string>> texts(rows.size());
  for (const Column<Row>& column : columns.all()) {
    headings.push_back(column.heading);
    for (std::size_t i = 0; i < rows.size(); ++i) texts[i].push_back(cell_text(column, rows[i]));
  }
  return text_table(std::move(headings), texts);
}

}  // namespace sim
