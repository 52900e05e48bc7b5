#pragma once
// What a result of listening brings to a report.
#include <string>

#include "sim/result/stored_dataset.hpp"
#include "sim/section/report_section.hpp"

namespace sim {

ReportSection false_accept_section(const std::string& name, const StoredDataset& stored);

}  // namespace sim
