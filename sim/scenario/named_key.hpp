#pragma once
// Keys of tables that a user names: [disturbance.NAME], [devices.NAME].
#include <optional>
#include <string>
#include <string_view>

namespace sim {

/// "NAME" and "WHAT" of "TABLE.NAME.WHAT".
struct NamedKey {
  std::string name, what;
};

/// Nothing if the key is not of that table; the name may still be one that nobody may have.
std::optional<NamedKey> named_key(std::string_view table, std::string_view key);

/// Letters, digits, - and _.
bool is_table_name(std::string_view name);

}  // namespace sim
