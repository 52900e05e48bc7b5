#pragma once
// What results of experiments that are no links bring to a report, the parts that all of them
// share.
#include <optional>
#include <string>
#include <vector>

#include "sim/result/stored_dataset.hpp"
#include "sim/section/dataset_charts.hpp"
#include "sim/section/dataset_table.hpp"
#include "sim/section/report_section.hpp"

namespace sim {

/// Adds a chart, if there is one with a curve.
void add_chart(ReportSection& report, std::optional<Chart> chart);

/// Adds those of a dataset's drawn columns that it has.
void add_charts(ReportSection& report, const Dataset& data,
                const std::vector<DrawnVariable>& drawn);

/// The last sections: all numbers of the points, with marks where one leaves the range of a model,
/// and the scenario.
void add_closing(ReportSection& report, const Dataset& data, std::vector<DatasetColumn> columns);

}  // namespace sim
