#include "sim/page/experiment_part.hpp"

#include <utility>

#include "sim/page/picture_sections.hpp"
#include "sim/report/outside_report.hpp"

namespace sim {

void add_chart(ReportPart& part, std::optional<Chart> chart) {
  if (chart && !chart->curves.empty()) part.charts.push_back(std::move(*chart));
}

void add_closing(ReportPart& part, const Dataset& data, const std::vector<DatasetColumn>& columns) {
  part.sections.push_back({.heading = "All numbers",
                           .text = outside_notes(data),
                           .table = dataset_table(data, columns)});
  part.sections.push_back(scenario_section(data.command, data.scenario_toml));
}

}  // namespace sim
