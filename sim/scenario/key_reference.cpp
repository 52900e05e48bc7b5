#include "sim/scenario/key_reference.hpp"

#include <fmt/format.h>

#include <cmath>

#include "protocol/cosys.hpp"
#include "sim/scenario/disturbance_keys.hpp"
#include "sim/scenario/flag_words.hpp"
#include "sim/scenario/key_check.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/scenario/placed_device_keys.hpp"

namespace sim {
namespace {

std::string default_of(const Key& key) {
  if (!part_giving(key.name()).empty()) return "from the part";
  Scenario defaults;
  if (key.facts.type == KeyType::flag) return flag_word(key, key.number(defaults));
  if (key.is_number() && std::isnan(key.number(defaults))) return "unset";
  if (key.is_number()) return fmt::format("{}", key.number(defaults));
  const std::string& value = key.text(defaults);
  return value.empty() ? "empty" : "`" + value + "`";
}

std::string allowed(const Key& key) {
  switch (key.facts.type) {
    case KeyType::number:
      return in_words(key.facts.range);
    case KeyType::whole_number:
      return "whole, " + in_words(key.facts.range);
    case KeyType::flag:
      return flag_words(key);
    case KeyType::text:
      return "text";
    case KeyType::message:
      return fmt::format("printable ASCII, up to {}", protocol::longest_message);
    case KeyType::choice:
      return fmt::format("`{}`", fmt::join(key.choices, "` or `"));
    case KeyType::part:
      return "a part's name";
    case KeyType::number_list:
      return "list, " + in_words(key.facts.range);
    case KeyType::messages:
      return fmt::format("a text or a list of them, printable ASCII, up to {}",
                         protocol::longest_message);
  }
  return "";
}

std::string table_row(const KeyFacts& facts, const std::string& name, const std::string& standard,
                      const std::string& range) {
  return fmt::format("| `{}` | {} | {} | {} | {}{}{} |\n", name,
                     facts.unit.empty() ? "-" : facts.unit, standard, range, facts.long_name,
                     facts.note.empty() ? "" : "; ", facts.note);
}

std::string table_head(const std::string& heading) {
  return fmt::format(
      "\n### {}\n\n| key | unit | default | range | meaning |\n|---|---|---|---|---|\n", heading);
}

std::string scenario_tables() {
  std::string out, group = "none";
  for (const Key& key : scenario_keys()) {
    const std::size_t dot = key.name().find('.');
    const std::string table = dot == std::string::npos ? "" : key.name().substr(0, dot);
    if (table != group) out += table_head(table.empty() ? "Top of the file" : "`[" + table + "]`");
    group = table;
    out += table_row(key.facts, key.name().substr(table.empty() ? 0 : dot + 1), default_of(key),
                     allowed(key));
  }
  return out;
}

std::string disturbance_table(const DisturbanceKind& kind) {
  const auto key = [](const std::string& what) { return *find_key("disturbance.NAME." + what); };
  std::string out = table_head(
      fmt::format("`[disturbance.NAME]` with `kind = \"{}\"`: {}", kind.name, kind.long_name));
  if (kind.has_message)
    out += table_row(key("message").facts, "message", "`" + DisturbanceSettings{}.message + "`",
                     allowed(key("message")));
  for (const DisturbanceNumber& n : kind.numbers)
    out += table_row(n.facts, n.facts.name, fmt::format("{:.6g}", n.standard),
                     allowed(key(n.facts.name)));
  return out;
}

std::string device_table() {
  std::string out = table_head("`[devices.NAME]` of an arena");
  for (const Key& key : placed_device_keys("NAME")) {
    const std::string name = key.name().substr(key.name().rfind('.') + 1);
    out += table_row(key.facts, name, default_of(key), allowed(key));
  }
  return out;
}

std::string disturbance_tables() {
  std::string out;
  for (const DisturbanceKind& kind : disturbance_kinds()) out += disturbance_table(kind);
  return out;
}

/// A number that cannot be the default stands for a part without it.
template <class Part>
std::string default_of(const PartNumber<Part>& number) {
  const double value = Part{}.*number.member;
  return number.facts.range.contains(value) ? fmt::format("{}", value) : "none";
}

/// What holds where a file does not give the key.
template <class Part>
std::string unless_given(const PartKeys<Part>& keys, const std::string& name, bool required,
                         const std::string& otherwise) {
  for (const auto& [one, other] : keys.either)
    if (name == one || name == other)
      return fmt::format("required, or `{}`", name == one ? other : one);
  return required ? "required" : otherwise;
}

template <class Part>
std::string part_table(const PartKeys<Part>& keys, const std::string& heading) {
  std::string out = table_head(heading);
  for (const auto& c : keys.choices)
    out += table_row(c.facts, c.facts.name, "`" + Part{}.*c.member + "`",
                     fmt::format("`{}`", fmt::join(c.choices, "` or `")));
  for (const auto& n : keys.numbers)
    out += table_row(n.facts, n.facts.name,
                     unless_given(keys, n.facts.name, n.required, default_of(n)),
                     in_words(n.facts.range));
  for (const auto& c : keys.curves)
    for (const KeyFacts* axis : {&c.x, &c.y}) {
      KeyFacts facts = *axis;
      facts.note = c.long_name;
      out += table_row(facts, c.name + "." + facts.name,
                       unless_given(keys, c.name, c.required, "none"),
                       "list, " + in_words(facts.range));
    }
  return out;
}

}  // namespace

std::string key_reference() {
  return scenario_tables() + disturbance_tables() + device_table() +
         part_table(module_keys(), "`modules/NAME.toml`") +
         part_table(led_keys(), "`leds/NAME.toml`") +
         part_table(floor_keys(), "`floors/NAME.toml`") +
         part_table(photodiode_keys(), "`photodiodes/NAME.toml`");
}

}  // namespace sim
