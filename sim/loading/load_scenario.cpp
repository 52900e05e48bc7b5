#include "sim/loading/load_scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "sim/components/drawn_part.hpp"
#include "sim/components/part_axis.hpp"
#include "sim/components/parts.hpp"
#include "sim/failure.hpp"
#include "sim/loading/parsed_scenario.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/disturbance_keys.hpp"
#include "sim/scenario/entries.hpp"
#include "sim/scenario/interval_file.hpp"
#include "sim/scenario/key_check.hpp"
#include "sim/scenario/keys.hpp"
#include "sim/scenario/source_locations.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/scenario/text_axis.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

/// Entries of a scenario, which may have any number of overrides and carried parts.
std::vector<Entry> scenario_entries(const std::string& text, const std::filesystem::path& path) {
  return read_entries(text, path, {"override", "part"});
}

std::string asked_for(const ParsedScenario& parsed, const std::string& key,
                      const std::string& part) {
  return fmt::format("{} = \"{}\" {}", key, part, place_of(parsed.places, key));
}

/// The part's file, and those of the parts that it is like.
template <class Data>
void carry(std::vector<CarriedPart>& parts, Part<Data> part) {
  parts.push_back(std::move(part.source));
  std::ranges::move(part.siblings, std::back_inserter(parts));
}

/// LEDs of devices that have one of their own.
void load_device_leds(Scenario& s, const ParsedScenario& parsed, const PartSources& from,
                      std::vector<CarriedPart>& parts) {
  for (auto& [name, device] : s.devices) {
    if (device.led.empty()) continue;
    auto led =
        load_led(device.led, from, asked_for(parsed, "devices." + name + ".led", device.led));
    device.emitter = std::move(led.data);
    carry(parts, std::move(led));
  }
}

/// The photodiode of an experiment that looks at the light itself.
void load_photodiode(Scenario& s, const ParsedScenario& parsed, const PartSources& from,
                     std::vector<CarriedPart>& parts) {
  const Key* key = find_key(s.experiment + ".photodiode");
  if (key == nullptr) return;
  const std::string& name = key->text(s);
  auto photodiode = load_photodiode(name, from, asked_for(parsed, key->name(), name));
  s.photodiode = std::move(photodiode.data);
  carry(parts, std::move(photodiode));
}

/// Files of pauses become lists in the parsed scenario, and in the options that repeat the run:
/// they are not carried with it.
void read_interval_files(ParsedScenario& parsed, const std::filesystem::path& scenario,
                         std::vector<std::string>& options) {
  const SourceLocations given = parsed.places;  // by name
  for (const auto& [name, place] : given) {
    if (!name.ends_with(".interval_file")) continue;
    const std::string file = std::exchange(parsed.texts[find_key(name)], "");
    if (file.empty()) continue;
    const std::string list = name.substr(0, name.rfind('.')) + ".intervals_ms";
    const std::string asked = fmt::format("{} = \"{}\" {}", name, file, place);
    if (parsed.texts.contains(find_key(list)))
      throw bad_input(asked, "the scenario also has " + list, "remove one of the two");
    const std::string values = read_number_lines(scenario.parent_path() / file, asked);
    parsed.set_text(*find_key(list), values, "in " + file);
    options.push_back(name + "=");
    options.push_back(fmt::format("{}={}", list, values));
  }
}

Assembly assemble(const ParsedScenario& parsed, const PartSources& from) {
  Scenario s;
  for (const auto& [key, value] : parsed.texts) key->text(s) = value;
  check_kinds(s, parsed.places);
  for (auto& [name, disturbance] : s.disturbances) take_defaults(disturbance);
  auto module =
      load_module(s.receiver.module, from, asked_for(parsed, "receiver.module", s.receiver.module));
  auto led = load_led(s.led.part, from, asked_for(parsed, "led.part", s.led.part));
  s.module = std::move(module.data);
  s.emitter = std::move(led.data);
  const std::string& floor_name = s.floor_settings.part;
  auto floor = load_floor(floor_name, from, asked_for(parsed, "floor.part", floor_name));
  s.floor = std::move(floor.data);
  for (const auto& [key, value] : parsed.numbers) key->number(s) = value;
  std::vector<CarriedPart> parts;
  carry(parts, std::move(module));
  carry(parts, std::move(led));
  carry(parts, std::move(floor));
  load_device_leds(s, parsed, from, parts);
  load_photodiode(s, parsed, from, parts);
  forget_given_bounds(s, parsed.places);
  if (!is_drawn_by_point(parsed.sweep)) place_unit(s);
  return {std::move(s), std::move(parts)};
}

bool is_part_axis(const Axis& axis) {
  return axis.is_text() && find_key(axis.key)->facts.type == KeyType::part;
}

/// Variants of the base for every axis of parts, and the files of all of them.
struct PartVariants {
  std::vector<std::vector<Scenario>> scenarios;  // one list an axis; empty of other axes
  std::vector<CarriedPart> parts;
};

void add_axis(PartVariants& to, ParsedScenario& parsed, Axis& axis, const PartSources& from) {
  const Key* key = find_key(axis.key);
  const auto with = [&](const std::string& part) {
    parsed.texts[key] = part;
    return assemble(parsed, from);
  };
  for (Assembly& each : load_part_axis(axis, from, place_of(parsed.places, axis.key), with)) {
    to.scenarios.back().push_back(std::move(each.scenario));
    std::ranges::move(each.parts, std::back_inserter(to.parts));
  }
  parsed.texts[key] = axis.labels.front();
}

/// Loads the parts of all axes. The base then has the first of each.
PartVariants load_variants(ParsedScenario& parsed, const PartSources& from) {
  PartVariants all;
  for (const Axis& axis : parsed.sweep)
    if (is_part_axis(axis))
      parsed.texts[find_key(axis.key)] = any_part(axis, from, place_of(parsed.places, axis.key));
  for (Axis& axis : parsed.sweep) {
    all.scenarios.emplace_back();
    if (is_part_axis(axis)) add_axis(all, parsed, axis, from);
  }
  return all;
}

// ---- text that repeats a run ----

/// Keys of axes written as "*", which may be another list elsewhere.
std::vector<std::string> keys_of_all(const std::vector<Axis>& sweep) {
  std::vector<std::string> keys;
  for (const Axis& axis : sweep)
    if (is_part_axis(axis) && std::ranges::find(axis.labels, all_texts) != axis.labels.end())
      keys.push_back(axis.key);
  return keys;
}

/// What "*" was, as of --set.
std::string spelt_out(const std::vector<Axis>& sweep, const std::string& key) {
  const auto axis = std::ranges::find(sweep, key, &Axis::key);
  return fmt::format("{}={},", key, fmt::join(axis->labels, ","));
}

/// As of --set, in the place where it was taken.
void spell_doubt_out(std::vector<std::string>& options) {
  if (std::erase(options, doubt_option) > 0) options.emplace_back(doubt_override);
}

std::string with_parts(std::string text, const std::vector<CarriedPart>& used,
                       const std::vector<CarriedPart>& carried) {
  std::set<std::string> known;
  for (const CarriedPart& part : carried) known.insert(part.file);
  for (const auto& [file, content] : used)
    if (known.insert(file).second)
      text += "\n[[part]]\n" + toml_string(file) + " = " + toml_lines(content) + "\n";
  return text;
}

std::string with_overrides(std::string text, const std::vector<std::string>& overrides) {
  for (const std::string& override : overrides)
    text += "\n[[override]]\nset = " + toml_string(override) + "\n";
  return text;
}

}  // namespace

LoadedScenario load_scenario(const std::filesystem::path& path,
                             const std::vector<std::string>& overrides,
                             const std::vector<std::filesystem::path>& roots) {
  const std::string text = read_text_file(path, "scenario");
  if (text.starts_with("\x89HDF"))
    throw bad_input(path.string(), "it is an HDF5 file, not a scenario",
                    "give the .toml; with --resume it goes on with its result");
  return parse_scenario(text, path, overrides, roots);
}

LoadedScenario parse_scenario(const std::string& text, const std::filesystem::path& path,
                              const std::vector<std::string>& overrides,
                              const std::vector<std::filesystem::path>& roots) {
  const std::vector<Entry> entries = scenario_entries(text, path);
  std::vector<std::string> options = with_amount_key(entries, overrides);
  ParsedScenario parsed = parsed_scenario_of(entries, options);
  spell_doubt_out(options);
  count_points(parsed.sweep);
  check_dimension_names(parsed.sweep);
  read_interval_files(parsed, path, options);
  const PartSources from{roots, parsed.parts, path};
  const std::vector<std::string> axes_of_all = keys_of_all(parsed.sweep);
  PartVariants variants = load_variants(parsed, from);
  Assembly assembly = assemble(parsed, from);
  std::ranges::move(variants.parts, std::back_inserter(assembly.parts));
  const std::string whole = with_parts(text, assembly.parts, parsed.parts);
  for (const std::string& key : axes_of_all) options.push_back(spelt_out(parsed.sweep, key));
  LoadedScenario loaded{
      std::move(assembly.scenario), with_overrides(whole, options), path,
      std::move(parsed.sweep),      std::move(parsed.places),       std::move(variants.scenarios)};
  check_all_points(loaded);
  scenario_entries(loaded.text, "--set");  // what repeats the run must itself be a scenario
  return loaded;
}

}  // namespace sim
