#include "sim/scenario/disturbance_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "sim/failure.hpp"
#include "sim/scenario/named_key.hpp"

namespace sim {
namespace {

const std::string table_of_disturbances = "disturbance";
const std::string disturbance_prefix = table_of_disturbances + ".";

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const DisturbanceKind& kind : disturbance_kinds()) names.push_back(kind.name);
  return names;
}

std::optional<NamedKey> parsed(const std::string& key) {
  return named_key(table_of_disturbances, key);
}

// ---- keys ----

Key kind_key(const std::string& name) {
  return {{"", "", {}, "kind of another light", "", KeyType::choice},
          {},
          [=](Scenario& s) -> std::string& { return s.disturbances[name].kind; },
          kind_names()};
}

Key message_key(const std::string& name) {
  return {{"", "", {}, "message of another device", "", KeyType::message},
          {},
          [=](Scenario& s) -> std::string& { return s.disturbances[name].message; },
          {}};
}

Key number_key(const std::string& name, const DisturbanceNumber& number) {
  const auto member = number.member;
  return {
      number.facts, [=](Scenario& s) -> double& { return s.disturbances[name].*member; }, {}, {}};
}

const DisturbanceNumber* find_number(const std::string& what) {
  for (const DisturbanceKind& kind : disturbance_kinds()) {
    const auto at = std::ranges::find(kind.numbers, what,
                                      [](const DisturbanceNumber& n) { return n.facts.name; });
    if (at != kind.numbers.end()) return &*at;
  }
  return nullptr;
}

std::optional<Key> make_key(const NamedKey& key) {
  if (key.what == "kind") return kind_key(key.name);
  if (key.what == "message") return message_key(key.name);
  if (const DisturbanceNumber* number = find_number(key.what)) return number_key(key.name, *number);
  return std::nullopt;
}

// ---- checks ----

bool has(const DisturbanceKind& kind, const std::string& what) {
  if (what == "kind") return true;
  if (what == "message") return kind.has_message;
  return std::ranges::any_of(kind.numbers, [&](const auto& n) { return n.facts.name == what; });
}

std::string in_words(const DisturbanceKind& kind) {
  std::vector<std::string> names;
  if (kind.has_message) names.emplace_back("message");
  for (const DisturbanceNumber& number : kind.numbers) names.push_back(number.facts.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void check_key(const Scenario& scenario, const std::string& key, const std::string& place) {
  const auto of = parsed(key);
  if (!of) return;
  const auto at = scenario.disturbances.find(of->name);
  if (at == scenario.disturbances.end() || at->second.kind.empty())
    throw bad_input(key + " " + place, "disturbance." + of->name + " has no kind",
                    fmt::format("add its kind: {}", fmt::join(kind_names(), ", ")));
  const DisturbanceKind& kind = kind_of(at->second);
  if (!has(kind, of->what))
    throw bad_input(key + " " + place, "no such key of kind " + kind.name,
                    "it has " + in_words(kind));
}

}  // namespace

const Key* find_disturbance_key(const std::string& name) {
  static std::map<std::string, Key> keys;
  const auto old = keys.find(name);
  if (old != keys.end()) return &old->second;
  const auto of = parsed(name);
  if (!of || !is_table_name(of->name)) return nullptr;
  auto key = make_key(*of);
  if (!key) return nullptr;
  key->facts.name = name;
  return &keys.emplace(name, std::move(*key)).first->second;
}

std::vector<std::string> disturbance_key_names(const std::string& name) {
  std::vector<std::string> names{disturbance_prefix + name + ".kind",
                                 disturbance_prefix + name + ".message"};
  for (const DisturbanceKind& kind : disturbance_kinds())
    for (const DisturbanceNumber& number : kind.numbers) {
      const std::string key = disturbance_prefix + name + "." + number.facts.name;
      if (std::ranges::find(names, key) == names.end()) names.push_back(key);
    }
  return names;
}

std::string disturbance_of(const std::string& key) {
  const auto of = parsed(key);
  return of ? of->name : "";
}

void take_defaults(DisturbanceSettings& disturbance) {
  for (const DisturbanceNumber& number : kind_of(disturbance).numbers)
    disturbance.*number.member = number.standard;
}

const DisturbanceKind& kind_of(const DisturbanceSettings& disturbance) {
  return *std::ranges::find(disturbance_kinds(), disturbance.kind, &DisturbanceKind::name);
}

void check_kinds(const Scenario& scenario, const SourceLocations& places) {
  for (const auto& [key, place] : places) check_key(scenario, key, place);
}

}  // namespace sim
