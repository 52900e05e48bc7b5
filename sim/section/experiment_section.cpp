#include "sim/section/experiment_section.hpp"

#include <fmt/format.h>

#include <utility>

#include "sim/columns/validity_column.hpp"
#include "sim/section/dataset_cells.hpp"
#include "sim/section/picture_sections.hpp"

namespace sim {
namespace {

/// The marks that `run` puts behind a point's row.
DatasetColumn outside_points(const Dataset& data) {
  return {validity_flags_name, "outside",
          [masks = DatasetCells(data, validity_flags_name)](std::size_t cell) {
            return validity_mark(masks.count(cell));
          }};
}

std::string marked_points(const Dataset& data) {
  const DatasetCells masks(data, validity_flags_name);
  std::size_t marked = 0;
  for (std::size_t i = 0; i < masks.size(); ++i) marked += masks.count(i) != 0;
  if (marked == 0) return "";
  return marked_line(masks.size(), {fmt::format("{} {}", marked, validity_words)});
}

}  // namespace

void add_chart(ReportSection& report, std::optional<Chart> chart) {
  if (chart && !chart->curves.empty()) report.charts.push_back(std::move(*chart));
}

void add_charts(ReportSection& report, const Dataset& data,
                const std::vector<DrawnVariable>& drawn) {
  for (const DrawnVariable& variable : drawn) add_chart(report, swept_chart(data, variable));
}

void add_closing(ReportSection& report, const Dataset& data, std::vector<DatasetColumn> columns) {
  report.summary += marked_points(data);
  const std::string notes = validity_notes(data);
  if (!notes.empty()) columns.push_back(outside_points(data));
  report.sections.push_back(
      {.heading = "All numbers", .text = notes, .table = dataset_table(data, std::move(columns))});
  report.scenario = scenario_section(data.command, data.scenario_toml);
}

}  // namespace sim
