#pragma once
// What a result of a robo-guard brings to a report.
#include <string>

#include "sim/page/report_part.hpp"
#include "sim/result/stored_dataset.hpp"

namespace sim {

ReportPart guard_part(const std::string& name, const StoredDataset& stored);

}  // namespace sim
