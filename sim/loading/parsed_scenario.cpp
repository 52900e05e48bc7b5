#include "sim/loading/parsed_scenario.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "sim/failure.hpp"
#include "sim/scenario/disturbance_keys.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/flag_words.hpp"
#include "sim/scenario/key_check.hpp"
#include "sim/scenario/named_key.hpp"
#include "sim/scenario/placed_device_keys.hpp"
#include "sim/scenario/scenario_key.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/scenario/text_axis.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"
#include "sim/text/quantity.hpp"
#include "sim/text/spelling.hpp"

namespace sim {

void ParsedScenario::set_number(const Key& key, double value, const std::string& place) {
  check_number(key.facts, value, place);
  numbers[&key] = value;
  places[key.name()] = place;
}

void ParsedScenario::set_text(const Key& key, const std::string& value, const std::string& place) {
  check_text(key, value, place);
  texts[&key] = value;
  places[key.name()] = place;
}

void ParsedScenario::set_axis(Axis axis, const std::string& place) {
  places[axis.key] = place;
  const auto old = std::ranges::find(sweep, axis.key, &Axis::key);
  if (old == sweep.end())
    sweep.push_back(std::move(axis));
  else
    *old = std::move(axis);
}

void ParsedScenario::drop_axis(const Key& key) {
  std::erase_if(sweep, [&](const Axis& axis) { return axis.key == key.name(); });
}

namespace {

constexpr std::string_view sweep_prefix = "sweep.";
constexpr std::string_view override_key = "override.set";
constexpr std::string_view part_prefix = "part.";

std::vector<std::string> table_names() {
  std::vector<std::string> tables{"sweep", "disturbance", "devices"};
  for (const Key& key : scenario_keys()) {
    const std::string table = key.name().substr(0, key.name().find('.'));
    if (table != key.name() && table != tables.back()) tables.push_back(table);
  }
  return tables;
}

const Key& sweepable_key(const std::string& name, const std::string& place) {
  const Key& key = scenario_key(name, place);
  if (key.is_number() || is_sweepable_text(key)) return key;
  throw bad_input(name + " " + place, "text cannot be swept", "write one scenario for each text");
}

[[noreturn]] void refuse_kind(const Entry& entry, const char* wanted, const char* remedy) {
  throw bad_input(entry.key + " " + entry.place,
                  fmt::format("{} where {} is expected", kind_of(entry.value), wanted), remedy);
}

bool is_empty_table(const Entry& entry) {
  const auto* other = std::get_if<OtherValue>(&entry.value);
  return other && other->what == "a table";
}

std::string guessed_table(const std::string& name, const std::vector<std::string>& tables) {
  const std::string guess = nearest(name, tables);
  return is_near(name, guess) ? "did you mean [" + guess + "]?"
                              : "scenarios/KEYS.md lists all tables";
}

/// A table without keys says nothing, but must still be one that could.
void check_empty_table(const Entry& entry) {
  const auto tables = table_names();
  if (is_table_name(disturbance_of(entry.key + ".kind")))
    throw bad_input("[" + entry.key + "] " + entry.place, "the disturbance has no kind",
                    "add its kind or remove the table");
  if (named_key("devices", entry.key + ".x"))
    throw bad_input("[" + entry.key + "] " + entry.place, "the device has no place",
                    "add x_m or remove the table");
  if (std::ranges::find(tables, entry.key) == tables.end())
    throw bad_input("[" + entry.key + "] " + entry.place, "no such table",
                    guessed_table(entry.key, tables));
}

double flag_in_quotes(const Key& key, const Entry& entry) {
  const auto* word = std::get_if<std::string>(&entry.value);
  const auto value = word && key.facts.range.high > 1 ? flag_value(key, *word) : std::nullopt;
  if (value) return *value;
  if (word && key.facts.range.high > 1)
    throw bad_input(fmt::format("{} = \"{}\" {}", entry.key, *word, entry.place),
                    "not " + flag_words(key), "use one of these");
  refuse_kind(entry, "true or false", "write true or false without quotes");
}

/// Of a text, a range or a list, with units or without; `problem` opens the error line.
std::vector<double> values_of(const Key& key, const std::string& text, const std::string& problem) {
  return parse_values(in_unit(text, key.facts.unit, problem), problem);
}

double number_of(const Key& key, const Entry& entry) {
  const auto* flag = std::get_if<bool>(&entry.value);
  if (flag && key.facts.type == KeyType::flag) return *flag ? 1 : 0;
  if (const auto* value = std::get_if<double>(&entry.value)) return *value;
  if (key.facts.type == KeyType::flag) return flag_in_quotes(key, entry);
  const auto* text = std::get_if<std::string>(&entry.value);
  if (text && has_unit(*text) && !is_range_or_list(*text)) {
    return values_of(key, *text, fmt::format("{} = \"{}\" {}", entry.key, *text, entry.place))
        .front();
  }
  refuse_kind(entry, "a number", "write a number without quotes; sweep in [sweep]");
}

/// A message a line: so none may have a line break of its own.
std::string messages_of(const Entry& entry) {
  std::vector<std::string> messages;
  if (const auto* one = std::get_if<std::string>(&entry.value))
    messages = {*one};
  else if (const auto* list = std::get_if<std::vector<std::string>>(&entry.value))
    messages = *list;
  else
    refuse_kind(entry, "a text or a list of texts", "write [\"A\", \"B\"]");
  for (const std::string& message : messages)
    if (message.find('\n') != std::string::npos)
      throw bad_input(entry.key + " " + entry.place, "a line break in a message",
                      "write [\"A\", \"B\"] for several messages");
  return fmt::format("{}", fmt::join(messages, "\n"));
}

/// Lists become texts too.
std::string text_of(const Key& key, const Entry& entry) {
  if (key.facts.type == KeyType::messages) return messages_of(entry);
  if (const auto* value = std::get_if<std::string>(&entry.value)) return *value;
  if (key.facts.type == KeyType::number_list) {
    if (const auto* value = std::get_if<double>(&entry.value)) return fmt::format("{}", *value);
    if (const auto* list = std::get_if<std::vector<double>>(&entry.value))
      return fmt::format("{}", fmt::join(*list, ","));
    refuse_kind(entry, "a list of numbers", "write [1, 2, 5]");
  }
  refuse_kind(entry, "text", "write the text in quotes");
}

void take_setting(ParsedScenario& parsed, const Entry& entry) {
  const Key& key = scenario_key(entry.key, entry.place);
  if (key.is_number()) {
    parsed.set_number(key, number_of(key, entry), entry.place);
  } else {
    const auto value = text_of(key, entry);
    if (value == all_texts && is_sweepable_text(key))
      throw bad_input(key.name() + " = \"*\" " + entry.place, "all are a sweep",
                      "write it in [sweep]");
    parsed.set_text(key, value, entry.place);
  }
}

std::vector<std::string> swept_texts(const Entry& entry) {
  if (const auto* text = std::get_if<std::string>(&entry.value)) return parse_texts(*text);
  if (const auto* list = std::get_if<std::vector<std::string>>(&entry.value)) return *list;
  const auto* numbers = std::get_if<std::vector<double>>(&entry.value);
  if (numbers && numbers->empty()) return {};
  refuse_kind(entry, "a list of texts", "write [\"A\", \"B\"] or \"*\" for all");
}

/// The values that words of a flag stand for; nothing where the entry is no list of words.
std::optional<std::vector<double>> swept_words(const Key& key, const Entry& entry) {
  if (key.facts.type != KeyType::flag) return std::nullopt;
  const auto* mixed = std::get_if<WordList>(&entry.value);
  const auto* texts =
      mixed != nullptr ? &mixed->words : std::get_if<std::vector<std::string>>(&entry.value);
  if (texts == nullptr) return std::nullopt;
  std::vector<double> values;
  for (const std::string& word : *texts) {
    const auto value = flag_value(key, word);
    if (!value)
      throw bad_input(fmt::format("{} = \"{}\" {}", key.name(), word, entry.place),
                      "not " + flag_words(key), "use " + flag_words(key));
    values.push_back(*value);
  }
  return values;
}

void take_sweep(ParsedScenario& parsed, const Entry& entry) {
  const std::string name = entry.key.substr(sweep_prefix.size());
  const Key& key = sweepable_key(name, entry.place);
  if (!key.is_number())
    return parsed.set_axis(make_text_axis(key, swept_texts(entry), entry.place), entry.place);
  if (const auto values = swept_words(key, entry))
    return parsed.set_axis(make_axis(key, *values, entry.place), entry.place);
  std::vector<double> values;
  if (const auto* number = std::get_if<double>(&entry.value))
    values = {*number};
  else if (const auto* list = std::get_if<std::vector<double>>(&entry.value))
    values = *list;
  else if (const auto* text = std::get_if<std::string>(&entry.value))
    values = values_of(key, *text, fmt::format("{} = \"{}\" {}", name, *text, entry.place));
  else
    refuse_kind(entry, "a range or list", "write \"1:1:20\" or [1, 2, 5]");
  parsed.set_axis(make_axis(key, std::move(values), entry.place), entry.place);
}

/// "true", "false", another word of the key, or several as a sweep.
void override_flag(ParsedScenario& parsed, const Key& key, const std::string& value,
                   const std::string& place) {
  std::vector<double> values;
  for (const std::string_view item : split(value, ',')) {
    const auto number = flag_value(key, trimmed(item));
    if (!number)
      throw bad_input(fmt::format("{} = {} {}", key.name(), value, place), "not " + flag_words(key),
                      "use " + flag_words(key));
    values.push_back(*number);
  }
  if (values.size() > 1) return parsed.set_axis(make_axis(key, values, place), place);
  parsed.set_number(key, values.front(), place);
  parsed.drop_axis(key);
}

void override_number(ParsedScenario& parsed, const Key& key, const std::string& value,
                     const std::string& place) {
  if (key.facts.type == KeyType::flag) return override_flag(parsed, key, value, place);
  const auto values = values_of(key, value, fmt::format("{} = {} {}", key.name(), value, place));
  if (is_range_or_list(value)) return parsed.set_axis(make_axis(key, values, place), place);
  parsed.set_number(key, values.front(), place);
  parsed.drop_axis(key);
}

void override_text(ParsedScenario& parsed, const Key& key, const std::string& value,
                   const std::string& place) {
  if (is_sweepable_text(key) && is_text_list(value))
    return parsed.set_axis(make_text_axis(key, parse_texts(value), place), place);
  parsed.set_text(key, value, place);
  parsed.drop_axis(key);
}

void take_override(ParsedScenario& parsed, const std::string& override, const std::string& place) {
  const std::size_t equals = override.find('=');
  if (equals == std::string::npos)
    throw bad_input("\"" + override + "\" " + place, "no = in it",
                    "write key=value, such as receiver.range_m=3");
  if (equals == 0)
    throw bad_input("\"" + override + "\" " + place,
                    "no key before the =", "write key=value, such as receiver.range_m=3");
  const std::string value = override.substr(equals + 1);
  const Key& key = scenario_key(override.substr(0, equals), value, place);
  if (key.is_number()) return override_number(parsed, key, value, place);
  override_text(parsed, key, value, place);
}

/// Where the scenario has not chosen its unit itself.
void take_doubt(ParsedScenario& parsed) {
  const auto chosen = parsed.places.find(unit_key);
  if (chosen != parsed.places.end())
    throw bad_input(fmt::format("{} with {} {}", doubt_option, unit_key, chosen->second),
                    "both say which units there are", "remove one of the two");
  take_override(parsed, std::string(doubt_override), fmt::format("by {}", doubt_option));
}

void take_file_override(ParsedScenario& parsed, const Entry& entry) {
  const auto* text = std::get_if<std::string>(&entry.value);
  if (!text) refuse_kind(entry, "text", "write set = \"key=value\"");
  take_override(parsed, *text, entry.place);
}

void take_part(ParsedScenario& parsed, const Entry& entry) {
  const std::string file = entry.key.substr(part_prefix.size());
  if (!is_part_file(file))
    throw bad_input(file + " " + entry.place, "no name of a part's file",
                    "write \"modules/NAME.toml\", \"leds/NAME.toml\", \"floors/NAME.toml\" or "
                    "\"photodiodes/NAME.toml\" in quotes");
  if (std::ranges::find(parsed.parts, file, &CarriedPart::file) != parsed.parts.end())
    throw bad_input(file + " " + entry.place, "carried twice", "remove one of the two");
  const auto* text = std::get_if<std::string>(&entry.value);
  if (!text) refuse_kind(entry, "text", "write the part's file between ''' and '''");
  parsed.parts.push_back({file, *text});
}

void take_entry(ParsedScenario& parsed, const Entry& entry) {
  if (entry.key == override_key) return;
  if (entry.key.starts_with(part_prefix)) return take_part(parsed, entry);
  if (is_empty_table(entry)) return check_empty_table(entry);
  if (entry.key.starts_with(sweep_prefix)) return take_sweep(parsed, entry);
  take_setting(parsed, entry);
}

}  // namespace

std::vector<std::string> with_amount_key(const std::vector<Entry>& entries,
                                         const std::vector<std::string>& overrides) {
  std::vector<std::string> named = overrides;
  const auto amounts = std::stable_partition(
      named.begin(), named.end(),
      [](const std::string& text) { return !text.starts_with(amount_option); });
  if (amounts == named.end()) return named;
  const ParsedScenario parsed = parsed_scenario_of(entries, {named.begin(), amounts});
  Scenario scenario;
  if (const auto said = parsed.texts.find(find_key("experiment")); said != parsed.texts.end())
    scenario.experiment = said->second;
  for (auto amount = amounts; amount != named.end(); ++amount)
    *amount = amount_key(scenario) + "=" + amount->substr(amount_option.size());
  return named;
}

ParsedScenario parsed_scenario_of(const std::vector<Entry>& entries,
                                  const std::vector<std::string>& overrides) {
  ParsedScenario parsed;
  for (const Entry& entry : entries) take_entry(parsed, entry);
  for (const Entry& entry : entries)
    if (entry.key == override_key) take_file_override(parsed, entry);
  for (const std::string& override : overrides)
    if (override != doubt_option) take_override(parsed, override, "in --set");
  if (std::ranges::find(overrides, doubt_option) != overrides.end()) take_doubt(parsed);
  return parsed;
}

}  // namespace sim
