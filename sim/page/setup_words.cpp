#include "sim/page/setup_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "sim/text/escaped_text.hpp"

namespace sim {
namespace {

std::string message_text(const std::string& message) {
  constexpr std::size_t most = 60;
  const std::string text = escaped(message);
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

/// Of a key that is swept neither a list nor "0 .. 10 lx (11 values)".
bool is_zero(const std::string& value) {
  return value == "0" || (value.starts_with("0 ") && !value.starts_with("0 .. "));
}

/// "A, B" or "A .. M (13 values)": of a part that is swept.
bool are_several(const std::string& part) {
  return part.find(", ") != std::string::npos || part.find(" .. ") != std::string::npos;
}

/// "0.6 W/m2 of ambient light"; none in the dark.
std::vector<std::string> steady_lights(const std::vector<Setting>& settings) {
  std::vector<std::string> lights;
  const auto add = [&](const std::string& key, const std::string& of) {
    const std::string value = setting_value(settings, key);
    if (!is_zero(value)) lights.push_back(value + of);
  };
  add("ambient.irradiance_w_per_m2", " of ambient light");
  add("ambient.daylight_lux", " of daylight");
  add("ambient.tungsten_lux", " of tungsten light");
  return lights;
}

/// "another light (fluorescent)"
std::vector<std::string> disturbances(const std::vector<Setting>& settings) {
  std::vector<std::string> lights;
  for (const Setting& setting : settings)
    if (setting.key.starts_with("disturbance.") && setting.key.ends_with(".kind"))
      lights.push_back(fmt::format("another light ({})", setting.value));
  return lights;
}

/// ", in 0.6 W/m2 of ambient light, beside another light (fluorescent)"; empty in the dark.
std::string light_words(const std::vector<Setting>& settings) {
  const std::vector<std::string> steady = steady_lights(settings);
  std::string words = steady.empty() ? "" : fmt::format(", in {}", fmt::join(steady, " and "));
  for (const std::string& light : disturbances(settings)) words += ", beside " + light;
  return words;
}

std::string place_words(const std::vector<Setting>& settings) {
  const auto value = [&](const char* key) { return setting_value(settings, key); };
  if (const std::string ebn0 = value("receiver.ebn0_db"); !ebn0.empty())
    return fmt::format("at Eb/N0 of {}", ebn0);
  const std::string others = light_words(settings);
  return fmt::format("from a {} at {}, {} away{}", value("led.part"), value("led.current_ma"),
                     value("receiver.range_m"), others.empty() ? ", in the dark" : others);
}

}  // namespace

std::string setting_value(const std::vector<Setting>& settings, const std::string& key) {
  const auto found = std::ranges::find(settings, key, &Setting::key);
  return found == settings.end() ? "" : found->value;
}

std::vector<std::string> other_lights(const std::vector<Setting>& settings) {
  std::vector<std::string> lights = steady_lights(settings);
  std::ranges::move(disturbances(settings), std::back_inserter(lights));
  return lights;
}

std::string setup_words(const std::vector<Setting>& settings) {
  const auto value = [&](const char* key) { return setting_value(settings, key); };
  const std::string module = value("receiver.module");
  return fmt::format("{}{} hears \"{}\" at {} on a carrier of {} {}.\n",
                     are_several(module) ? "Each of " : "", module,
                     message_text(value("device.message")), value("device.baud"),
                     value("device.carrier_hz"), place_words(settings));
}

}  // namespace sim
