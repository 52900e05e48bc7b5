#pragma once
// What results of presence and of location bring to a report.
#include <string>

#include "sim/result/stored_dataset.hpp"
#include "sim/section/report_section.hpp"

namespace sim {

ReportSection presence_section(const std::string& name, const StoredDataset& stored);
ReportSection location_section(const std::string& name, const StoredDataset& stored);

}  // namespace sim
