#include "sim/section/columns_section.hpp"

#include <fmt/format.h>

#include <cctype>

#include "sim/section/dataset_words.hpp"
#include "sim/section/experiment_section.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

/// "sum of eyes [1]": the heading of the terminal's table in one line, or else the name.
std::string head_of(const ColumnFacts& column) {
  std::string head;
  for (const std::string& line : column.heading.names)
    if (!line.empty() && line != "[interval]" && !line.starts_with("["))
      head += (head.empty() ? "" : " ") + line;
  if (head.empty()) head = plain_words(column.facts.name);
  const std::string unit = bracketed_unit(column.facts.unit);
  return unit.empty() ? head : head + " " + unit;
}

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

/// The table columns that are on just these dimensions.
std::vector<DatasetColumn> table_columns(const std::vector<ColumnFacts>& columns,
                                         const std::vector<std::string>& dimensions) {
  std::vector<DatasetColumn> found;
  for (const ColumnFacts& column : columns)
    if (column.is_stored() && column.over == dimensions)
      found.push_back({column.facts.name, head_of(column)});
  return found;
}

void add_drawn(ReportSection& part, const Dataset& data, const ColumnFacts& column) {
  if (!column.is_stored() || !column.drawing) return;
  const std::string unit = bracketed_unit(column.facts.unit);
  if (column.over.empty())
    part.summary += extremes(data, column.facts.name, column.drawing->title,
                             unit.empty() ? "" : " " + column.facts.unit);
  add_chart(part, swept_chart(data, {column.facts.name, *column.drawing}));
}

}  // namespace

ReportSection columns_section(const std::string& name, const StoredDataset& stored,
                              const std::vector<ColumnFacts>& columns) {
  const Dataset& data = stored.data;
  ReportSection part{name, data.title, fmt::format("The result is of {}.\n", runs_text(data))};
  for (const ColumnFacts& column : columns) add_drawn(part, data, column);
  part.summary += missing_points(stored);
  for (const Dataset::Dimension& dimension : data.dimensions)
    if (const auto table = table_columns(columns, {dimension.facts.name}); !table.empty())
      part.sections.push_back(
          {.heading = capitalised(dimension.facts.long_name), .table = dataset_table(data, table)});
  add_closing(part, data, table_columns(columns, {}));
  return part;
}

}  // namespace sim
