#pragma once
// What a result of listening brings to a report.
#include <string>

#include "sim/page/report_part.hpp"
#include "sim/result/stored_dataset.hpp"

namespace sim {

ReportPart listening_part(const std::string& name, const StoredDataset& stored);

}  // namespace sim
