#pragma once
// How the tables of keys are written down: one call a key, for the groups of a Scenario.
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/scenario/key.hpp"

namespace sim {

/// The settings that an experiment has in a scenario (ExperimentSettings).
template <class Group>
struct SettingsOf {};

template <class Group>
Group& group_of(Scenario& s, Group Scenario::*group) {
  return s.*group;
}
template <class Group>
Group& group_of(Scenario& s, SettingsOf<Group>) {
  return s.settings.of<Group>();
}

/// Of a group that `at` names: a member of Scenario, or SettingsOf an experiment.
template <class At, class Group>
Key number(std::string name, std::string unit, Range range, At at, double Group::*member,
           std::string long_name, std::string note = "", KeyType type = KeyType::number) {
  return {{std::move(name), std::move(unit), range, std::move(long_name), std::move(note), type},
          [=](Scenario& s) -> double& { return group_of(s, at).*member; },
          {},
          {}};
}

template <class... Rest>
Key whole(Rest&&... rest) {
  Key key = number(std::forward<Rest>(rest)...);
  key.facts.type = KeyType::whole_number;
  return key;
}

template <class At, class Group>
Key flag(std::string name, At at, double Group::*member, std::string long_name, std::string note) {
  Key key = number(std::move(name), "1", from(0, 1), at, member, std::move(long_name),
                   std::move(note), KeyType::flag);
  key.choices = {"false", "true"};
  return key;
}

/// A flag of more values than two, each with its word.
inline Key with_words(Key key, std::vector<std::string> words) {
  key.facts.range = from(0, static_cast<double>(words.size() - 1));
  key.choices = std::move(words);
  return key;
}

template <class At, class Group>
Key text(KeyType type, std::string name, At at, std::string Group::*member, std::string long_name,
         std::string note = "", std::vector<std::string> choices = {}) {
  Key key{{std::move(name), "", {}, std::move(long_name), std::move(note), type},
          {},
          [=](Scenario& s) -> std::string& { return group_of(s, at).*member; },
          std::move(choices)};
  key.physics = type != KeyType::part;
  return key;
}

/// Numbers that belong together, which are no sweep.
template <class At, class Group>
Key number_list(std::string name, std::string unit, Range range, At at, std::string Group::*member,
                std::string long_name, std::string note = "") {
  Key key = text(KeyType::number_list, std::move(name), at, member, std::move(long_name),
                 std::move(note));
  key.facts.unit = std::move(unit);
  key.facts.range = range;
  return key;
}

inline Key no_physics(Key key) {
  key.physics = false;
  return key;
}

inline Key younger(Key key) {
  key.younger = true;
  return key;
}

inline std::vector<Key> all_younger(std::vector<Key> keys) {
  for (Key& key : keys) key.younger = true;
  return keys;
}

/// The names of a table of named rows.
template <class Row>
std::vector<std::string> names_of(std::span<const Row> table) {
  std::vector<std::string> names;
  for (const Row& row : table) names.emplace_back(row.name);
  return names;
}

}  // namespace sim
