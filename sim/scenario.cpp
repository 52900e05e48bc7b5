#include "sim/scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <variant>

#include "sim/disturbance_keys.hpp"
#include "sim/entries.hpp"
#include "sim/failure.hpp"
#include "sim/key_check.hpp"
#include "sim/keys.hpp"
#include "sim/part_axis.hpp"
#include "sim/parts.hpp"
#include "sim/point_scenario.hpp"
#include "sim/sweep.hpp"
#include "sim/text_axis.hpp"
#include "sim/text_file.hpp"

namespace sim {
namespace {

constexpr std::string_view sweep_prefix = "sweep.";
constexpr std::string_view override_key = "override.set";
constexpr std::string_view part_prefix = "part.";

/// Entries of a scenario, which may have any number of overrides and carried parts.
std::vector<Entry> scenario_entries(const std::string& text, const std::filesystem::path& path) {
  return read_entries(text, path, {"override", "part"});
}

/// Names that could have been meant.
std::vector<std::string> names_like(const std::string& name) {
  std::vector<std::string> names;
  const std::string disturbance = disturbance_of(name);
  if (!disturbance.empty()) names = disturbance_key_names(disturbance);
  for (const Key& key : scenario_keys()) names.push_back(key.name());
  return names;
}

std::vector<std::string> table_names() {
  std::vector<std::string> tables{"sweep", "disturbance"};
  for (const Key& key : scenario_keys()) {
    const std::string table = key.name().substr(0, key.name().find('.'));
    if (table != key.name() && table != tables.back()) tables.push_back(table);
  }
  return tables;
}

const Key& known_key(const std::string& name, const std::string& place) {
  if (const Key* key = find_key(name)) return *key;
  const std::string disturbance = disturbance_of(name);
  if (!disturbance.empty() && !is_disturbance_name(disturbance))
    throw bad_input(name + " " + place, "no name of a disturbance",
                    "use letters, digits, - and _ for it");
  throw bad_input(name + " " + place, "no such key",
                  "did you mean " + nearest(name, names_like(name)) + "?");
}

const Key& sweepable_key(const std::string& name, const std::string& place) {
  const Key& key = known_key(name, place);
  if (key.is_number() || is_sweepable_text(key)) return key;
  throw bad_input(name + " " + place, "text cannot be swept", "write one scenario for each text");
}

/// What file and command line say, before parts are looked up: they depend on the final names.
struct Draft {
  std::map<const Key*, double> numbers;
  std::map<const Key*, std::string> texts;
  std::vector<Axis> sweep;
  std::vector<CarriedPart> parts;
  Places places;

  void set_number(const Key& key, double value, const std::string& place) {
    check_number(key.facts, value, place);
    numbers[&key] = value;
    places[key.name()] = place;
  }

  void set_text(const Key& key, const std::string& value, const std::string& place) {
    check_text(key, value, place);
    texts[&key] = value;
    places[key.name()] = place;
  }

  void set_axis(Axis axis, const std::string& place) {
    places[axis.key] = place;
    const auto old = std::ranges::find(sweep, axis.key, &Axis::key);
    if (old == sweep.end())
      sweep.push_back(std::move(axis));
    else
      *old = std::move(axis);
  }

  void drop_axis(const Key& key) {
    std::erase_if(sweep, [&](const Axis& axis) { return axis.key == key.name(); });
  }
};

// ---- from entries and overrides into a draft ----

[[noreturn]] void refuse_kind(const Entry& entry, const char* wanted, const char* remedy) {
  throw bad_input(entry.key + " " + entry.place,
                  fmt::format("{} where {} is expected", kind_of(entry.value), wanted), remedy);
}

bool is_empty_table(const Entry& entry) {
  const auto* other = std::get_if<OtherValue>(&entry.value);
  return other && other->what == "a table";
}

/// A table without keys says nothing, but must still be one that could.
void check_empty_table(const Entry& entry) {
  const auto tables = table_names();
  if (is_disturbance_name(disturbance_of(entry.key + ".kind")))
    throw bad_input("[" + entry.key + "] " + entry.place, "the disturbance has no kind",
                    "add its kind or remove the table");
  if (std::ranges::find(tables, entry.key) == tables.end())
    throw bad_input("[" + entry.key + "] " + entry.place, "no such table",
                    "did you mean [" + nearest(entry.key, tables) + "]?");
}

double number_of(const Key& key, const Entry& entry) {
  const auto* flag = std::get_if<bool>(&entry.value);
  if (flag && key.facts.type == KeyType::flag) return *flag ? 1 : 0;
  if (const auto* value = std::get_if<double>(&entry.value)) return *value;
  if (key.facts.type == KeyType::flag)
    refuse_kind(entry, "true or false", "write true or false without quotes");
  refuse_kind(entry, "a number", "write a number without quotes; sweep in [sweep]");
}

void take_setting(Draft& draft, const Entry& entry) {
  const Key& key = known_key(entry.key, entry.place);
  if (key.is_number()) {
    draft.set_number(key, number_of(key, entry), entry.place);
  } else {
    const auto* value = std::get_if<std::string>(&entry.value);
    if (!value) refuse_kind(entry, "text", "write the text in quotes");
    draft.set_text(key, *value, entry.place);
  }
}

std::vector<std::string> swept_texts(const Entry& entry) {
  if (const auto* text = std::get_if<std::string>(&entry.value)) return parse_texts(*text);
  if (const auto* list = std::get_if<std::vector<std::string>>(&entry.value)) return *list;
  const auto* numbers = std::get_if<std::vector<double>>(&entry.value);
  if (numbers && numbers->empty()) return {};
  refuse_kind(entry, "a list of texts", "write [\"A\", \"B\"] or \"*\" for all");
}

void take_sweep(Draft& draft, const Entry& entry) {
  const std::string name = entry.key.substr(sweep_prefix.size());
  const Key& key = sweepable_key(name, entry.place);
  if (!key.is_number())
    return draft.set_axis(make_text_axis(key, swept_texts(entry), entry.place), entry.place);
  std::vector<double> values;
  if (const auto* number = std::get_if<double>(&entry.value))
    values = {*number};
  else if (const auto* list = std::get_if<std::vector<double>>(&entry.value))
    values = *list;
  else if (const auto* text = std::get_if<std::string>(&entry.value))
    values = parse_values(*text, fmt::format("{} = \"{}\" {}", name, *text, entry.place));
  else
    refuse_kind(entry, "a range or list", "write \"1:1:20\" or [1, 2, 5]");
  draft.set_axis(make_axis(key, std::move(values), entry.place), entry.place);
}

void override_number(Draft& draft, const Key& key, const std::string& value,
                     const std::string& place) {
  if (key.facts.type == KeyType::flag && (value == "true" || value == "false"))
    return override_number(draft, key, value == "true" ? "1" : "0", place);
  const auto values = parse_values(value, fmt::format("{} = {} {}", key.name(), value, place));
  if (is_range_or_list(value)) return draft.set_axis(make_axis(key, values, place), place);
  draft.set_number(key, values.front(), place);
  draft.drop_axis(key);
}

void override_text(Draft& draft, const Key& key, const std::string& value,
                   const std::string& place) {
  if (is_sweepable_text(key) && is_text_list(value))
    return draft.set_axis(make_text_axis(key, parse_texts(value), place), place);
  draft.set_text(key, value, place);
  draft.drop_axis(key);
}

void take_override(Draft& draft, const std::string& override, const std::string& place) {
  const std::size_t equals = override.find('=');
  if (equals == std::string::npos)
    throw bad_input("\"" + override + "\" " + place, "no = in it",
                    "write key=value, such as receiver.range_m=3");
  const Key& key = known_key(override.substr(0, equals), place);
  const std::string value = override.substr(equals + 1);
  if (key.is_number()) return override_number(draft, key, value, place);
  override_text(draft, key, value, place);
}

void take_file_override(Draft& draft, const Entry& entry) {
  const auto* text = std::get_if<std::string>(&entry.value);
  if (!text) refuse_kind(entry, "text", "write set = \"key=value\"");
  take_override(draft, *text, entry.place);
}

void take_part(Draft& draft, const Entry& entry) {
  const std::string file = entry.key.substr(part_prefix.size());
  if (!is_part_file(file))
    throw bad_input(
        file + " " + entry.place, "no name of a part's file",
        "write \"modules/NAME.toml\", \"leds/NAME.toml\" or \"floors/NAME.toml\" in quotes");
  if (std::ranges::find(draft.parts, file, &CarriedPart::file) != draft.parts.end())
    throw bad_input(file + " " + entry.place, "carried twice", "remove one of the two");
  const auto* text = std::get_if<std::string>(&entry.value);
  if (!text) refuse_kind(entry, "text", "write the part's file between ''' and '''");
  draft.parts.push_back({file, *text});
}

void take_entry(Draft& draft, const Entry& entry) {
  if (entry.key == override_key) return;
  if (entry.key.starts_with(part_prefix)) return take_part(draft, entry);
  if (is_empty_table(entry)) return check_empty_table(entry);
  if (entry.key.starts_with(sweep_prefix)) return take_sweep(draft, entry);
  take_setting(draft, entry);
}

Draft draft_of(const std::vector<Entry>& entries, const std::vector<std::string>& overrides) {
  Draft draft;
  for (const Entry& entry : entries) take_entry(draft, entry);
  for (const Entry& entry : entries)
    if (entry.key == override_key) take_file_override(draft, entry);
  for (const std::string& override : overrides) take_override(draft, override, "in --set");
  return draft;
}

// ---- from a draft to a scenario ----

std::string asked_for(const Draft& draft, const std::string& key, const std::string& part) {
  return fmt::format("{} = \"{}\" {}", key, part, place_of(draft.places, key));
}

Assembly assemble(const Draft& draft, const PartSources& from) {
  Scenario s;
  for (const auto& [key, value] : draft.texts) key->text(s) = value;
  check_kinds(s, draft.places);
  for (auto& [name, disturbance] : s.disturbances) take_defaults(disturbance);
  auto module =
      load_module(s.receiver.module, from, asked_for(draft, "receiver.module", s.receiver.module));
  auto led = load_led(s.led.part, from, asked_for(draft, "led.part", s.led.part));
  s.module = std::move(module.data);
  s.emitter = std::move(led.data);
  const std::string& floor_name = s.floor_settings.part;
  auto floor = load_floor(floor_name, from, asked_for(draft, "floor.part", floor_name));
  s.floor = std::move(floor.data);
  for (const auto& [key, value] : draft.numbers) key->number(s) = value;
  return {std::move(s), {std::move(module.source), std::move(led.source), std::move(floor.source)}};
}

bool is_part_axis(const Axis& axis) {
  return axis.is_text() && find_key(axis.key)->facts.type == KeyType::part;
}

/// Variants of the base for every axis of parts, and the files of all of them.
struct PartVariants {
  std::vector<std::vector<Scenario>> scenarios;  // one list an axis; empty of other axes
  std::vector<CarriedPart> parts;
};

void add_axis(PartVariants& to, Draft& draft, Axis& axis, const PartSources& from) {
  const Key* key = find_key(axis.key);
  const auto with = [&](const std::string& part) {
    draft.texts[key] = part;
    return assemble(draft, from);
  };
  for (Assembly& each : load_part_axis(axis, from, place_of(draft.places, axis.key), with)) {
    to.scenarios.back().push_back(std::move(each.scenario));
    std::ranges::move(each.parts, std::back_inserter(to.parts));
  }
  draft.texts[key] = axis.labels.front();
}

/// Loads the parts of all axes. The base then has the first of each.
PartVariants load_variants(Draft& draft, const PartSources& from) {
  PartVariants all;
  for (const Axis& axis : draft.sweep)
    if (is_part_axis(axis))
      draft.texts[find_key(axis.key)] = any_part(axis, from, place_of(draft.places, axis.key));
  for (Axis& axis : draft.sweep) {
    all.scenarios.emplace_back();
    if (is_part_axis(axis)) add_axis(all, draft, axis, from);
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
  return parse_scenario(read_text_file(path, "scenario"), path, overrides, roots);
}

LoadedScenario parse_scenario(const std::string& text, const std::filesystem::path& path,
                              const std::vector<std::string>& overrides,
                              const std::vector<std::filesystem::path>& roots) {
  Draft draft = draft_of(scenario_entries(text, path), overrides);
  count_points(draft.sweep);
  const PartSources from{roots, draft.parts, path};
  const std::vector<std::string> axes_of_all = keys_of_all(draft.sweep);
  PartVariants variants = load_variants(draft, from);
  Assembly assembly = assemble(draft, from);
  std::ranges::move(variants.parts, std::back_inserter(assembly.parts));
  const std::string whole = with_parts(text, assembly.parts, draft.parts);
  std::vector<std::string> options = overrides;
  for (const std::string& key : axes_of_all) options.push_back(spelt_out(draft.sweep, key));
  LoadedScenario loaded{
      std::move(assembly.scenario), with_overrides(whole, options), path,
      std::move(draft.sweep),       std::move(draft.places),        std::move(variants.scenarios)};
  check_all_points(loaded);
  scenario_entries(loaded.text, "--set");  // what repeats the run must itself be a scenario
  return loaded;
}

}  // namespace sim
