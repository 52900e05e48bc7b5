#include "sim/page/differences.hpp"

#include <algorithm>

namespace sim {
namespace {

std::string value_in(const NamedSettings& result, const std::string& key) {
  const auto found = std::ranges::find(result.settings, key, &Setting::key);
  return found == result.settings.end() || found->value.empty() ? "-" : found->value;
}

/// Of all results, each once.
std::vector<std::string> keys_of(const std::vector<NamedSettings>& results) {
  std::vector<std::string> keys;
  for (const NamedSettings& result : results)
    for (const Setting& setting : result.settings)
      if (std::ranges::find(keys, setting.key) == keys.end()) keys.push_back(setting.key);
  return keys;
}

}  // namespace

PageSection differences_section(const std::vector<NamedSettings>& results) {
  PageTable table{.head = {"key"}, .rows = {}};
  for (const NamedSettings& result : results) table.head.push_back(result.name);
  for (const std::string& key : keys_of(results)) {
    std::vector<std::string> row{key};
    for (const NamedSettings& result : results) row.push_back(value_in(result, key));
    if (std::ranges::count(row, row[1]) + 1 < std::ssize(row)) table.rows.push_back(row);
  }
  PageSection section{.heading = "Differences"};
  if (table.rows.empty())
    section.text = "All keys of their scenarios are set alike.";
  else
    section.table = std::move(table);
  return section;
}

}  // namespace sim
