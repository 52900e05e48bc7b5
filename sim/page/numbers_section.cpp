#include "sim/page/numbers_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "sim/columns/columns_table.hpp"
#include "sim/columns/page_heading.hpp"
#include "sim/columns/text_table.hpp"
#include "sim/columns/validity_column.hpp"
#include "sim/link_experiment/link_columns.hpp"
#include "sim/link_experiment/link_notes.hpp"
#include "sim/section/swept_curves.hpp"

namespace sim {
namespace {

bool is_known(const Column<LinkPoint>& column, const LinkPoint& point) {
  return point.reached() && cell_text(column, point) != "-";
}

/// Those of the terminal's table, and those that have a name for a page.
std::vector<Column<LinkPoint>> columns_of(const LinkResult& result) {
  std::vector<Column<LinkPoint>> columns = link_columns().all();
  std::erase_if(columns, [&](const Column<LinkPoint>& column) {
    if (!column.has_heading() && column.page_heading.empty()) return true;
    return column.is_shown != nullptr &&
           std::ranges::none_of(result.points, [&](const auto& p) { return is_known(column, p); });
  });
  return columns;
}

PageTable table_of(const LinkResult& result) {
  PageTable table;
  const std::vector<Column<LinkPoint>> columns = columns_of(result);
  for (const Axis& axis : result.axes) table.head.push_back(axis_name(axis));
  for (const auto& column : columns) table.head.push_back(page_heading(column));
  for (const LinkPoint& point : result.points) {
    if (!point.reached()) continue;
    std::vector<std::string> row = coordinate_texts(result.axes, point.coordinates);
    for (const auto& column : columns) row.push_back(cell_text(column, point));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

PageSection numbers_section(const LinkResult& result) {
  return {.heading = "All numbers", .text = mark_notes(result), .table = table_of(result)};
}

std::string marked_points(const LinkResult& result) {
  const auto outside = std::ranges::count_if(
      result.points, [](const LinkPoint& point) { return point.validity_flags != 0; });
  const auto alarming = std::ranges::count_if(
      result.points, [](const LinkPoint& point) { return point.alarms != 0; });
  std::vector<std::string> marks;
  if (outside > 0) marks.push_back(fmt::format("{} {}", outside, validity_words));
  if (alarming > 0) marks.push_back(fmt::format("{} with an alarm", alarming));
  return marked_line(result.points.size(), marks);
}

}  // namespace sim
