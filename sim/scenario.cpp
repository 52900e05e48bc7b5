#include "sim/scenario.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>

#include "sim/keys.hpp"
#include "sim/parts.hpp"
#include "sim/sweep.hpp"

namespace sim {
namespace {

using Places = std::map<std::string, std::string>;

constexpr std::string_view sweep_prefix = "sweep.";
constexpr std::string_view override_key = "override.set";

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const Key& key : scenario_keys()) names.push_back(key.name());
  return names;
}

std::vector<std::string> table_names() {
  std::vector<std::string> tables{"sweep"};
  for (const Key& key : scenario_keys()) {
    const std::string table = key.name().substr(0, key.name().find('.'));
    if (table != key.name() && table != tables.back()) tables.push_back(table);
  }
  return tables;
}

const Key& known_key(const std::string& name, const std::string& place) {
  if (const Key* key = find_key(name)) return *key;
  throw bad_input(name + " " + place, "no such key",
                  "did you mean " + nearest(name, all_names()) + "?");
}

const Key& numeric_key(const std::string& name, const std::string& place) {
  const Key& key = known_key(name, place);
  if (key.is_number()) return key;
  throw bad_input(name + " " + place, "text cannot be swept", "write one scenario for each text");
}

std::string place_of(const Places& places, const std::string& key) {
  const auto at = places.find(key);
  if (at != places.end()) return at->second;
  return key.starts_with("module.") ? "from the part" : "by default";
}

/// What file and command line say, before parts are looked up: they depend on the final names.
struct Draft {
  std::map<const Key*, double> numbers;
  std::map<const Key*, std::string> texts;
  std::vector<Axis> sweep;
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
  if (std::ranges::find(tables, entry.key) == tables.end())
    throw bad_input("[" + entry.key + "] " + entry.place, "no such table",
                    "did you mean [" + nearest(entry.key, tables) + "]?");
}

void take_setting(Draft& draft, const Entry& entry) {
  const Key& key = known_key(entry.key, entry.place);
  if (key.is_number()) {
    const auto* value = std::get_if<double>(&entry.value);
    if (!value) refuse_kind(entry, "a number", "write a number without quotes; sweep in [sweep]");
    draft.set_number(key, *value, entry.place);
  } else {
    const auto* value = std::get_if<std::string>(&entry.value);
    if (!value) refuse_kind(entry, "text", "write the text in quotes");
    draft.set_text(key, *value, entry.place);
  }
}

void take_sweep(Draft& draft, const Entry& entry) {
  const std::string name = entry.key.substr(sweep_prefix.size());
  const Key& key = numeric_key(name, entry.place);
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
  const auto values = parse_values(value, fmt::format("{} = {} {}", key.name(), value, place));
  if (is_range_or_list(value)) return draft.set_axis(make_axis(key, values, place), place);
  draft.set_number(key, values.front(), place);
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
  draft.set_text(key, value, place);
}

void take_file_override(Draft& draft, const Entry& entry) {
  const auto* text = std::get_if<std::string>(&entry.value);
  if (!text) refuse_kind(entry, "text", "write set = \"key=value\"");
  take_override(draft, *text, entry.place);
}

void take_entry(Draft& draft, const Entry& entry) {
  if (entry.key == override_key) return;
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

Scenario scenario_of(const Draft& draft, const PartRoots& roots) {
  Scenario s;
  for (const auto& [key, value] : draft.texts) key->text(s) = value;
  s.module =
      load_module(s.receiver.module, roots, asked_for(draft, "receiver.module", s.receiver.module));
  s.emitter = load_led(s.led.part, roots, asked_for(draft, "led.part", s.led.part));
  for (const auto& [key, value] : draft.numbers) key->number(s) = value;
  return s;
}

// ---- keys against each other ----

/// `large` must be at least `times` as large as `small`.
struct Limit {
  const Key* small;
  const Key* large;
  double times;
  const char* why;
};

const std::vector<Limit>& limits() {
  static const std::vector<Limit> table{
      {find_key("device.interval_min_ms"), find_key("device.interval_max_ms"), 1,
       "the shortest pause cannot exceed the longest"},
      {find_key("device.carrier_hz"), find_key("simulation.sample_rate_hz"), 4,
       "a carrier period takes at least 4 samples"},
      {find_key("module.centre_hz"), find_key("simulation.sample_rate_hz"), 4,
       "a period of the band-pass takes at least 4 samples"},
      {find_key("device.baud"), find_key("device.carrier_hz"), 4,
       "a bit takes at least 4 carrier periods"},
      {find_key("device.baud"), find_key("simulation.sample_rate_hz"), 100,
       "a bit takes at least 100 samples"},
      {find_key("module.emin_mw_per_m2"), find_key("module.emax_w_per_m2"), 1e-3,
       "the threshold cannot exceed the largest irradiance"},
  };
  return table;
}

[[noreturn]] void refuse_together(const Limit& limit, double small, double large,
                                  const Places& places) {
  const std::string &a = limit.small->name(), &b = limit.large->name();
  throw bad_input(fmt::format("{} = {} {} with {} = {} {}", a, small, place_of(places, a), b, large,
                              place_of(places, b)),
                  limit.why,
                  fmt::format("lower {} to {} or raise {} to {}", a, large / limit.times, b,
                              small * limit.times));
}

void check_together(Scenario& s, const Places& places) {
  for (const Limit& limit : limits()) {
    const double small = limit.small->number(s), large = limit.large->number(s);
    if (large < limit.times * small) refuse_together(limit, small, large, places);
  }
}

using Setters = std::vector<const Key*>;

Setters setters_of(const std::vector<Axis>& sweep) {
  Setters setters;
  for (const Axis& axis : sweep) setters.push_back(find_key(axis.key));
  return setters;
}

void place_at(Scenario& s, const Setters& setters, const std::vector<double>& coordinates) {
  assert(setters.size() == coordinates.size());
  for (std::size_t i = 0; i < setters.size(); ++i) setters[i]->number(s) = coordinates[i];
}

void check_all_points(const LoadedScenario& loaded) {
  const Setters setters = setters_of(loaded.sweep);
  const std::size_t n = count_points(loaded.sweep);
  Scenario s = loaded.base;
  for (std::size_t i = 0; i < n; ++i) {
    place_at(s, setters, point_coordinates(loaded.sweep, i));
    check_together(s, loaded.places);
  }
}

// ---- text that repeats a run ----

std::string toml_string(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') out += '\\';
    if (byte < 0x20 || byte == 0x7f)
      out += fmt::format("\\u{:04X}", byte);
    else
      out += c;
  }
  return out + '"';
}

std::string with_overrides(std::string text, const std::vector<std::string>& overrides) {
  for (const std::string& override : overrides)
    text += "\n[[override]]\nset = " + toml_string(override) + "\n";
  return text;
}

bool is_physics(const Key& key) {
  return key.facts.type != KeyType::part && key.name() != "title" &&
         key.name() != "simulation.seed" && !key.name().starts_with("stop.");
}

std::string exact(double value) { return fmt::format("{}", value + 0.0); }  // no negative zero

std::string curve_text(const std::string& name, const channel::Curve& curve) {
  std::string line = name + " =";
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    line += fmt::format(" {}:{}", exact(curve.x[i]), exact(curve.y[i]));
  return line + '\n';
}

template <class Part>
std::string curves_text(const PartKeys<Part>& keys, const Part& part) {
  std::string lines;
  for (const auto& curve : keys.curves)
    lines += curve_text(keys.folder + "." + curve.name, part.*curve.member);
  return lines;
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
  Draft draft = draft_of(read_entries(text, path), overrides);
  count_points(draft.sweep);
  LoadedScenario loaded{scenario_of(draft, roots), with_overrides(text, overrides), path,
                        std::move(draft.sweep), std::move(draft.places)};
  check_all_points(loaded);
  read_entries(loaded.text, "--set");  // what repeats the run must itself be a scenario
  return loaded;
}

Scenario point_scenario(const LoadedScenario& loaded, const std::vector<double>& coordinates) {
  Scenario s = loaded.base;
  place_at(s, setters_of(loaded.sweep), coordinates);
  check_together(s, loaded.places);
  return s;
}

std::string canonical_text(const Scenario& scenario) {
  Scenario s = scenario;  // keys give access for writing
  std::string lines;
  for (const Key& key : scenario_keys())
    if (is_physics(key))
      lines += fmt::format("{} = {}\n", key.name(),
                           key.is_number() ? exact(key.number(s)) : toml_string(key.text(s)));
  return lines + curves_text(module_keys(), s.module) + curves_text(led_keys(), s.emitter);
}

}  // namespace sim
