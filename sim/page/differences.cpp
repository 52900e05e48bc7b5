#include "sim/page/differences.hpp"

#include <algorithm>

namespace sim {
namespace {

std::string value_in(const ReportPart& part, const std::string& key) {
  const auto found = std::ranges::find(part.settings, key, &Setting::key);
  return found == part.settings.end() || found->value.empty() ? "-" : found->value;
}

/// Of all parts, each once.
std::vector<std::string> keys_of(const std::vector<ReportPart>& parts) {
  std::vector<std::string> keys;
  for (const ReportPart& part : parts)
    for (const Setting& setting : part.settings)
      if (std::ranges::find(keys, setting.key) == keys.end()) keys.push_back(setting.key);
  return keys;
}

}  // namespace

PageSection differences_section(const std::vector<ReportPart>& parts) {
  PageTable table{.head = {"key"}, .rows = {}};
  for (const ReportPart& part : parts) table.head.push_back(part.name);
  for (const std::string& key : keys_of(parts)) {
    std::vector<std::string> row{key};
    for (const ReportPart& part : parts) row.push_back(value_in(part, key));
    if (std::ranges::count(row, row[1]) + 1 < std::ssize(row)) table.rows.push_back(row);
  }
  PageSection section{.heading = "In what they differ"};
  if (table.rows.empty())
    section.text = "All keys of their scenarios are set alike.";
  else
    section.table = std::move(table);
  return section;
}

}  // namespace sim
