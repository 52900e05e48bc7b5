#pragma once
// What results of presence and of location bring to a report.
#include <string>

#include "sim/page/report_part.hpp"
#include "sim/result/stored_dataset.hpp"

namespace sim {

ReportPart presence_part(const std::string& name, const StoredDataset& stored);
ReportPart location_part(const std::string& name, const StoredDataset& stored);

}  // namespace sim
