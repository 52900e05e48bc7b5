#include "sim/section/columns_section.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "sim/result/place_text.hpp"
#include "sim/section/dataset_words.hpp"
#include "sim/section/experiment_section.hpp"
#include "sim/text/letters.hpp"

namespace sim {
namespace {

/// The columns of numbers that are on just these dimensions. Marks come from add_closing, and of
/// texts a file has only the numbers.
std::vector<DatasetColumn> table_columns(const Dataset& data,
                                         const std::vector<ColumnFacts>& columns,
                                         const std::vector<std::string>& dimensions) {
  std::vector<DatasetColumn> found;
  for (const ColumnFacts& column : columns) {
    const Dataset::Variable* variable = find_variable(data, column.facts.name);
    if (variable != nullptr && variable->on_axes && variable->flags.empty() && !column.is_text &&
        column.over == dimensions)
      found.push_back(headed_column(data, column));
  }
  return found;
}

/// The dimensions of the columns, each combination once.
std::vector<std::vector<std::string>> combinations(const std::vector<ColumnFacts>& columns) {
  std::vector<std::vector<std::string>> all;
  for (const ColumnFacts& column : columns)
    if (column.is_stored() && !column.over.empty() &&
        std::ranges::find(all, column.over) == all.end())
      all.push_back(column.over);
  return all;
}

/// "Faces of the dice"
std::string heading_of(const Dataset& data, const std::vector<std::string>& dimensions) {
  std::string heading;
  for (const std::string& name : dimensions)
    heading = joined(heading, dimension_named(data, name).facts.long_name);
  return capitalised(heading);
}

void add_drawn(ReportSection& report, const Dataset& data, const ColumnFacts& column) {
  if (!column.is_stored() || !column.drawing) return;
  report.summary += extremes_of(data, {column});
  add_chart(report, swept_chart(data, {column.facts.name, *column.drawing}));
}

}  // namespace

ReportSection columns_section(const std::string& name, const StoredDataset& stored,
                              const std::vector<ColumnFacts>& columns) {
  const Dataset& data = stored.data;
  ReportSection report{name, data.title, fmt::format("The result is of {}.\n", runs_text(data))};
  for (const ColumnFacts& column : columns) add_drawn(report, data, column);
  report.summary += missing_points(stored);
  for (const std::vector<std::string>& dimensions : combinations(columns))
    if (const auto table = table_columns(data, columns, dimensions); !table.empty())
      report.sections.push_back(
          {.heading = heading_of(data, dimensions), .table = dataset_table(data, table)});
  add_closing(report, data, table_columns(data, columns, {}));
  return report;
}

}  // namespace sim
