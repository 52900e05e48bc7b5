#pragma once
// What a result of SharedLink over light brings to a report.
#include <string>

#include "sim/page/report_part.hpp"
#include "sim/result/stored_dataset.hpp"

namespace sim {

ReportPart exchange_part(const std::string& name, const StoredDataset& stored);

}  // namespace sim
