#include "sim/scenario/canonical_text.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "sim/scenario/disturbance_keys.hpp"
#include "sim/scenario/entries.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/scenario/placed_device_keys.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

std::string exact(double value) { return fmt::format("{}", value + 0.0); }  // no negative zero

std::string exact_list(const std::string& list) {
  std::string text;
  for (const double value : parse_values(list, ""))
    text += (text.empty() ? "" : ",") + exact(value);
  return text;
}

std::string value_text(const Key& key, Scenario& s) {
  if (key.is_number()) return exact(key.number(s));
  const std::string& text = key.text(s);
  return toml_string(key.facts.type == KeyType::number_list && !text.empty() ? exact_list(text)
                                                                             : text);
}

bool is_younger_default(const Key& key, Scenario& s) {
  if (!key.younger) return false;
  Scenario defaults;
  return value_text(key, s) == value_text(key, defaults);
}

std::string curve_text(const std::string& name, const channel::Curve& curve) {
  std::string line = name + " =";
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    line += fmt::format(" {}:{}", exact(curve.x[i]), exact(curve.y[i]));
  return line + '\n';
}

template <class Part>
std::string choices_text(const PartKeys<Part>& keys, const Part& part) {
  std::string lines;
  for (const auto& choice : keys.choices)
    lines += fmt::format("{}.{} = {}\n", keys.folder, choice.facts.name, part.*choice.member);
  return lines;
}

template <class Part>
std::string curves_text(const PartKeys<Part>& keys, const Part& part) {
  std::string lines;
  for (const auto& curve : keys.curves)
    lines += curve_text(keys.folder + "." + curve.name, part.*curve.member);
  return lines;
}

template <class Part>
std::string numbers_text(const PartKeys<Part>& keys, const Part& part) {
  std::string lines;
  for (const auto& number : keys.numbers)
    lines +=
        fmt::format("{}.{} = {}\n", keys.folder, number.facts.name, exact(part.*number.member));
  return lines;
}

/// Only where each trial draws from them.
std::string bounds_text(const Scenario& s) {
  if (s.receiver.population != population_with_constants) return "";
  std::string lines;
  for (const channel::NumberBounds& b : s.module.bounds)
    lines += fmt::format("modules.{} = {} to {} {}\n", b.number, exact(b.low), exact(b.high),
                         static_cast<int>(b.distribution));
  return lines;
}

std::string disturbances_text(const Scenario& s) {
  std::string lines;
  for (const auto& [name, disturbance] : s.disturbances) {
    const DisturbanceKind& kind = kind_of(disturbance);
    lines += fmt::format("disturbance.{}.kind = {}\n", name, kind.name);
    if (kind.has_message)
      lines += fmt::format("disturbance.{}.message = {}\n", name, toml_string(disturbance.message));
    for (const DisturbanceNumber& number : kind.numbers)
      lines += fmt::format("disturbance.{}.{} = {}\n", name, number.facts.name,
                           exact(disturbance.*number.member));
  }
  return lines;
}

std::string devices_text(Scenario& s) {
  std::string lines;
  for (const auto& [name, device] : s.devices) {
    for (const Key& key : placed_device_keys(name))
      lines += fmt::format("{} = {}\n", key.name(), value_text(key, s));
    if (!device.led.empty())
      lines += numbers_text(led_keys(), device.emitter) + curves_text(led_keys(), device.emitter);
  }
  return lines;
}

/// Nothing where the experiment has none.
std::string photodiode_text(const Scenario& s) {
  return s.photodiode.name.empty() ? "" : numbers_text(photodiode_keys(), s.photodiode);
}

}  // namespace

std::string canonical_text(const Scenario& scenario) {
  Scenario s = scenario;  // keys give access for writing
  std::string lines;
  for (const Key& key : scenario_keys())
    if (key.physics && !is_younger_default(key, s))
      lines += fmt::format("{} = {}\n", key.name(), value_text(key, s));
  return lines + disturbances_text(s) + devices_text(s) + choices_text(module_keys(), s.module) +
         curves_text(module_keys(), s.module) + bounds_text(s) +
         numbers_text(led_keys(), s.emitter) + curves_text(led_keys(), s.emitter) +
         photodiode_text(s);
}

}  // namespace sim
