#include "sim/key_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numeric>

namespace sim {
namespace {

/// Levenshtein distance, case aside.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (const char ca : a) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const bool same = std::tolower(static_cast<unsigned char>(ca)) ==
                        std::tolower(static_cast<unsigned char>(b[j]));
      const std::size_t change = diagonal + (same ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({change, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

/// Edit distance, except that a name cut short, as by a forgotten unit, is only one slip.
std::size_t slips(const std::string& name, const std::string& candidate) {
  return candidate.starts_with(name) ? 1 : edit_distance(name, candidate);
}

std::size_t unlikeness(const std::string& name, const std::string& candidate) {
  const std::size_t dot = candidate.find('.');
  if (dot == std::string::npos) return slips(name, candidate);
  return std::min(slips(name, candidate), 1 + slips(name, candidate.substr(dot + 1)));
}

std::string violation(const Range& range, double value) {
  if (value > range.high) return fmt::format("at most {}", range.high);
  return fmt::format("{} {}", range.low_open ? "above" : "at least", range.low);
}

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() || unit == "1" ? text : text + " " + unit;
}

bool is_control(char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }
bool is_wire_character(char c) { return c >= ' ' && c <= '~'; }

void check_message(const std::string& value, const std::string& problem) {
  if (value.size() > longest_message)
    throw bad_input(problem,
                    fmt::format("a message has at most {} characters, this one {}", longest_message,
                                value.size()),
                    "shorten it");
  if (!std::ranges::all_of(value, is_wire_character))
    throw bad_input(problem, "a message is printable ASCII, from space to ~",
                    "remove the other characters");
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

}  // namespace

std::string nearest(const std::string& name, const std::vector<std::string>& candidates) {
  const auto likeness = [&](const std::string& c) { return unlikeness(name, c); };
  const auto best = std::ranges::min_element(candidates, {}, likeness);
  return best == candidates.end() ? "" : *best;
}

Failure bad_input(const std::string& problem, const std::string& why,
                  const std::string& suggestion) {
  std::string line = fmt::format("{} ({}) {}", problem, why, suggestion);
  std::ranges::replace_if(line, is_control, '?');
  return {ExitCode::bad_input, line};
}

std::string in_words(const Range& range) {
  return range.low_open ? fmt::format("above {} up to {}", range.low, range.high)
                        : fmt::format("{} to {}", range.low, range.high);
}

void check_number(const KeyFacts& facts, double value, const std::string& place) {
  const std::string problem = fmt::format("{} = {} {}", facts.name, value, place);
  const bool whole_number = facts.type == KeyType::whole_number;
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
  constexpr std::size_t shown = 60;
  const std::string shown_value = value.size() > shown ? value.substr(0, shown) + "..." : value;
  const std::string problem = fmt::format("{} = \"{}\" {}", key.name(), shown_value, place);
  if (key.facts.type == KeyType::message) return check_message(value, problem);
  if (key.facts.type == KeyType::choice) return check_choice(key, value, problem);
  check_title(value, problem);
}

}  // namespace sim
