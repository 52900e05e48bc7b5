#pragma once
// What a result of an arena brings to a report.
#include <string>
#include <vector>

#include "sim/result/stored_dataset.hpp"
#include "sim/section/dataset_shares.hpp"
#include "sim/section/dataset_table.hpp"
#include "sim/section/report_section.hpp"

namespace sim {

/// What becomes of messages.
std::vector<CountedKind> arena_losses();

/// What is said of messages in a report's pictures and tables. Columns may be of arena_sums.hpp.
struct MessageTables {
  std::vector<CountedKind> losses;  // delivery first
  std::vector<DatasetColumn> devices, points;
};

/// Names of columns of messages, from those sent to frame loss. `of`: "" of each device, "total_"
/// of all.
void add_message_columns(std::vector<std::string>& names, const std::string& of);
/// Names of columns of a point from the first message on: load, throughput, false messages.
void add_load_columns(std::vector<std::string>& names);

/// Maps, what became of the messages, frame loss, all devices.
ReportSection section_of_messages(const std::string& name, StoredDataset stored,
                                  const MessageTables& tables);

ReportSection arena_section(const std::string& name, const StoredDataset& stored);

}  // namespace sim
