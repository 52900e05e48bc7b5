#pragma once
// What a result of an arena brings to a report.
#include <string>
#include <vector>

#include "sim/page/report_part.hpp"
#include "sim/result/stored_dataset.hpp"

namespace sim {

/// A fate of messages: the variable that counts it, and its words.
struct CountedFate {
  std::string name, words;
};
std::vector<CountedFate> arena_fates();

/// Maps, what became of the messages, frame loss, all devices; `fates` has delivery first.
ReportPart part_of_messages(const std::string& name, const StoredDataset& stored,
                            const std::vector<CountedFate>& fates);

ReportPart arena_part(const std::string& name, const StoredDataset& stored);

}  // namespace sim
