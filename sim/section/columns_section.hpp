#pragma once
// What a result brings to a report by its columns alone: how much was run, where each drawn column
// is least and greatest, its curves, and a table for the points and for each combination of
// dimensions that columns have.
#include <string>
#include <vector>

#include "sim/columns/column.hpp"
#include "sim/result/stored_dataset.hpp"
#include "sim/section/report_section.hpp"

namespace sim {

ReportSection columns_section(const std::string& name, const StoredDataset& stored,
                              const std::vector<ColumnFacts>& columns);

}  // namespace sim
