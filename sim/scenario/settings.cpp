#include "sim/scenario/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/scenario/disturbance_keys.hpp"
#include "sim/scenario/flag_words.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/scenario/placed_device_keys.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

std::string value_of(const Key& key, Scenario& scenario) {
  if (!key.is_number()) return key.text(scenario);
  const double value = key.number(scenario);
  if (key.facts.type == KeyType::flag) return flag_word(key, value);
  return std::isnan(value) ? "" : with_unit(fmt::format("{}", value), key.facts.unit);
}

/// All of a few; of more the first and the last, and how many they are.
std::string values_of(const Axis& axis) {
  constexpr std::size_t few = 6;
  const std::size_t size = axis.values.size();
  std::string text;
  for (std::size_t i = 0; i < (size > few ? 1 : size); ++i)
    text += (i == 0 ? "" : ", ") + coordinate_text(axis, axis.values[i]);
  if (size > few) text += " .. " + coordinate_text(axis, axis.values.back());
  text = with_unit(text, axis.unit);
  return size > few ? fmt::format("{} ({} values)", text, size) : text;
}

/// Of a key that the scenario leaves to a part, the key of that.
std::string setting_of(const LoadedScenario& scenario, const Key& key, Scenario& base) {
  const std::string part = part_giving(key.name());
  return part.empty() || scenario.places.contains(key.name()) ? value_of(key, base) : "by " + part;
}

void add_disturbances(std::vector<Setting>& settings, Scenario& scenario) {
  for (const auto& [name, disturbance] : scenario.disturbances)
    for (const std::string& key_name : disturbance_key_names(name))
      if (const Key* key = find_disturbance_key(key_name))
        settings.push_back({key_name, value_of(*key, scenario)});
}

void add_devices(std::vector<Setting>& settings, Scenario& scenario) {
  for (const auto& [name, device] : scenario.devices)
    for (const Key& key : placed_device_keys(name))
      settings.push_back({key.name(), value_of(key, scenario)});
}

}  // namespace

std::vector<Setting> settings_of(const LoadedScenario& scenario) {
  Scenario base = scenario.base;  // keys give access for writing
  std::vector<Setting> settings;
  for (const Key& key : scenario_keys())
    settings.push_back({key.name(), setting_of(scenario, key, base)});
  add_disturbances(settings, base);
  add_devices(settings, base);
  for (const Axis& axis : scenario.sweep) {
    const auto swept = std::ranges::find(settings, axis.key, &Setting::key);
    if (swept != settings.end()) swept->value = values_of(axis);
  }
  return settings;
}

}  // namespace sim
