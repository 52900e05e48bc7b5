#include "sim/scenario/key_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/cosys.hpp"
#include "sim/text/letters.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"
#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

std::string violation(const Range& range, double value) {
  if (value > range.high) return fmt::format("at most {}", range.high);
  return fmt::format("{} {}", range.low_open ? "above" : "at least", range.low);
}

void check_message(const std::string& value, const std::string& problem) {
  if (const auto why = protocol::problem_in_message(value))
    throw bad_input(
        problem, *why,
        fmt::format("use printable ASCII, at most {} characters", protocol::longest_message));
}

void check_choice(const Key& key, const std::string& value, const std::string& problem) {
  if (std::ranges::find(key.choices, value) != key.choices.end()) return;
  throw bad_input(problem, "the " + key.facts.long_name + " is one of a list",
                  fmt::format("use {}", fmt::join(key.choices, " or ")));
}

void check_title(const std::string& value, const std::string& problem) {
  if (std::ranges::any_of(value, is_control))
    throw bad_input(problem, "a text is one line without control characters", "remove them");
}

/// As much of a text as an error line has room for.
std::string shortened(const std::string& value) {
  constexpr std::size_t shown = 60;
  return value.size() > shown ? value.substr(0, shown) + "..." : value;
}

void check_number_list(const Key& key, const std::string& value, const std::string& place) {
  KeyFacts each = key.facts;
  each.type = KeyType::number;
  for (const double number :
       parse_values(value, fmt::format("{} = {} {}", key.name(), shortened(value), place)))
    check_number(each, number, place);
}

void check_messages(const std::string& value, const std::string& problem) {
  for (const std::string_view message : split(value, '\n'))
    check_message(std::string(message), problem);
}

}  // namespace

std::string in_words(const Range& range) {
  return range.low_open ? fmt::format("above {} up to {}", range.low, range.high)
                        : fmt::format("{} to {}", range.low, range.high);
}

void check_number(const KeyFacts& facts, double value, const std::string& place) {
  const std::string problem = fmt::format("{} = {} {}", facts.name, value, place);
  const bool whole_number = facts.type == KeyType::whole_number || facts.type == KeyType::flag;
  const std::string remedy =
      fmt::format("use a {} {}", whole_number ? "whole number" : "value", in_words(facts.range));
  if (!std::isfinite(value)) throw bad_input(problem, "not a finite number", remedy);
  if (whole_number && value != std::floor(value))
    throw bad_input(problem, facts.long_name + ": only whole numbers", remedy);
  if (!facts.range.contains(value))
    throw bad_input(problem,
                    fmt::format("{} must be {}", facts.long_name,
                                with_unit(violation(facts.range, value), facts.unit)),
                    remedy);
}

void check_text(const Key& key, const std::string& value, const std::string& place) {
  const std::string problem = fmt::format("{} = \"{}\" {}", key.name(), shortened(value), place);
  if (key.facts.type == KeyType::message) return check_message(value, problem);
  if (key.facts.type == KeyType::choice) return check_choice(key, value, problem);
  if (key.facts.type == KeyType::number_list) return check_number_list(key, value, place);
  if (key.facts.type == KeyType::messages) return check_messages(value, problem);
  check_title(value, problem);
}

}  // namespace sim
