#include "sim/key_reference.hpp"

#include <fmt/format.h>

#include "protocol/cosys.hpp"
#include "sim/key_check.hpp"
#include "sim/keys.hpp"

namespace sim {
namespace {

std::string default_of(const Key& key) {
  if (key.name().starts_with("module.")) return "from the part";
  Scenario defaults;
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
    case KeyType::text:
      return "text";
    case KeyType::message:
      return fmt::format("printable ASCII, up to {}", protocol::longest_message);
    case KeyType::choice:
      return fmt::format("`{}`", fmt::join(key.choices, "` or `"));
    case KeyType::part:
      return "a part's name";
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

template <class Part>
std::string part_table(const PartKeys<Part>& keys, const std::string& heading) {
  std::string out = table_head(heading);
  for (const auto& n : keys.numbers)
    out += table_row(n.facts, n.facts.name,
                     n.required ? "required" : fmt::format("{}", Part{}.*n.member),
                     in_words(n.facts.range));
  for (const auto& c : keys.curves)
    for (const KeyFacts* axis : {&c.x, &c.y}) {
      KeyFacts facts = *axis;
      facts.note = c.long_name;
      out += table_row(facts, c.name + "." + facts.name, c.required ? "required" : "none",
                       "list, " + in_words(facts.range));
    }
  return out;
}

}  // namespace

std::string key_reference() {
  return scenario_tables() + part_table(module_keys(), "`modules/NAME.toml`") +
         part_table(led_keys(), "`leds/NAME.toml`");
}

}  // namespace sim
