#pragma once
// What a result of an arena brings to a report.
#include <string>
#include <vector>

#include "sim/page/dataset_shares.hpp"
#include "sim/page/report_part.hpp"
#include "sim/result/stored_dataset.hpp"

namespace sim {

/// What becomes of messages.
std::vector<CountedKind> arena_fates();

/// Maps, what became of the messages, frame loss, all devices; `fates` has delivery first.
ReportPart part_of_messages(const std::string& name, const StoredDataset& stored,
                            const std::vector<CountedKind>& fates);

ReportPart arena_part(const std::string& name, const StoredDataset& stored);

}  // namespace sim
