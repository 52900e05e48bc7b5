#include "sim/scenario/scenario_key.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "sim/failure.hpp"
#include "sim/scenario/disturbance_keys.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/scenario/named_key.hpp"
#include "sim/scenario/placed_device_keys.hpp"
#include "sim/text/quantity.hpp"
#include "sim/text/spelling.hpp"

namespace sim {
namespace {

/// Names that could have been meant.
std::vector<std::string> names_like(const std::string& name) {
  std::vector<std::string> names;
  if (const auto of = named_key("disturbance", name)) names = disturbance_key_names(of->name);
  if (const auto of = named_key("devices", name))
    for (const Key& key : placed_device_keys(of->name)) names.push_back(key.name());
  for (const Key& key : scenario_keys()) names.push_back(key.name());
  return names;
}

/// A table that a user names, and what it is.
struct NamedTable {
  std::string table, one, example;
};

void check_table_name(const NamedTable& named, const std::string& key, const std::string& place) {
  const auto of = named_key(named.table, key);
  if (of && !is_table_name(of->name))
    throw bad_input(key + " " + place, "no name of a " + named.one,
                    "use letters, digits, - and _ for it");
  if (!of && key.starts_with(named.table))
    throw bad_input(key + " " + place, "a " + named.one + " has a name",
                    fmt::format("write [{0}.NAME], such as [{0}.{1}]", named.table, named.example));
}

/// The only key whose name is this one and a unit; null where there is none.
const Key* key_of_quantity(const std::string& name) {
  const std::string begin = name + "_";
  const Key* found = nullptr;
  for (const std::string& other : names_like(name)) {
    if (!other.starts_with(begin)) continue;
    const Key* key = find_key(other);
    if (!key->is_number() || key->facts.unit == "1") continue;
    if (found != nullptr) return nullptr;
    found = key;
  }
  return found;
}

}  // namespace

const Key& scenario_key(const std::string& name, const std::string& place) {
  if (const Key* key = find_key(name)) return *key;
  check_table_name({"disturbance", "disturbance", "lamp"}, name, place);
  check_table_name({"devices", "device", "charger"}, name, place);
  const std::string guess = nearest(name, names_like(name));
  throw bad_input(
      name + " " + place, "no such key",
      is_near(name, guess) ? "did you mean " + guess + "?" : "scenarios/KEYS.md lists all keys");
}

const Key& scenario_key(const std::string& name, std::string_view value, const std::string& place) {
  if (find_key(name) == nullptr && has_unit(value))
    if (const Key* key = key_of_quantity(name)) return *key;
  return scenario_key(name, place);
}

}  // namespace sim
