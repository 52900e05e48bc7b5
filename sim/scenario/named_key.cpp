#include "sim/scenario/named_key.hpp"

#include <algorithm>

namespace sim {

std::optional<NamedKey> named_key(std::string_view table, std::string_view key) {
  const std::size_t last = key.rfind('.');
  const std::size_t first = table.size() + 1;
  if (!key.starts_with(table) || key.substr(table.size(), 1) != "." || last < first)
    return std::nullopt;
  return NamedKey{std::string(key.substr(first, last - first)), std::string(key.substr(last + 1))};
}

bool is_table_name(std::string_view name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  });
}

}  // namespace sim
