#pragma once
// What a result of SharedLink over light brings to a report.
#include <string>

#include "sim/result/stored_dataset.hpp"
#include "sim/section/report_section.hpp"

namespace sim {

ReportSection shared_link_section(const std::string& name, const StoredDataset& stored);

}  // namespace sim
