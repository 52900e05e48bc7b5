#pragma once
// What a result of an arena brings to a report.
#include <string>
#include <vector>

#include "sim/page/dataset_shares.hpp"
#include "sim/page/dataset_table.hpp"
#include "sim/page/report_part.hpp"
#include "sim/result/stored_dataset.hpp"

namespace sim {

/// What becomes of messages.
std::vector<CountedKind> arena_fates();

/// What is said of messages in a report's pictures and tables. Columns may be of arena_sums.hpp.
struct MessageTables {
  std::vector<CountedKind> fates;  // delivery first
  std::vector<DatasetColumn> devices, points;
};

/// Columns that `run` prints of messages, from those sent to frame loss. `of`: "" of each device,
/// "total_" of all; `delivered`: what delivery is called.
void add_message_columns(std::vector<DatasetColumn>& columns, const std::string& of,
                         const std::string& delivered);
/// Columns of a point from the first message on: load, throughput, false messages.
void add_load_columns(std::vector<DatasetColumn>& columns);

/// Maps, what became of the messages, frame loss, all devices.
ReportPart part_of_messages(const std::string& name, StoredDataset stored,
                            const MessageTables& tables);

ReportPart arena_part(const std::string& name, const StoredDataset& stored);

}  // namespace sim
