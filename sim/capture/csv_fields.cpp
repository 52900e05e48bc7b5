#include "sim/capture/csv_fields.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "sim/text/letters.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double beyond = std::numeric_limits<double>::infinity();
constexpr double least_beyond = 9.9e36;

std::string unquoted(std::string_view field) {
  std::string_view text = trimmed(field);
  while (!text.empty() && text.front() == '"') text.remove_prefix(1);
  while (!text.empty() && text.back() == '"') text.remove_suffix(1);
  return std::string(trimmed(text));
}

/// Quotes that are not closed are letters like others.
std::vector<std::string> parted(std::string_view line, char separator) {
  const bool has_quotes = std::ranges::count(line, '"') % 2 == 0;
  std::vector<std::string> fields;
  bool is_quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') is_quoted = has_quotes && !is_quoted;
    if (i < line.size() && (line[i] != separator || is_quoted)) continue;
    fields.push_back(unquoted(line.substr(begin, i - begin)));
    begin = i + 1;
  }
  return fields;
}

bool is_bracketed(const std::string& field) {
  return (field.starts_with('(') && field.ends_with(')')) ||
         (field.starts_with('[') && field.ends_with(']'));
}

bool says_nothing(const std::string& field) {
  constexpr std::string_view words[] = {"", "x", "z", "-", "none", "null", "na", "n/a", "#n/a"};
  return field.size() <= 4 && std::ranges::find(words, in_lower_case(field)) != std::end(words);
}

std::optional<double> beyond_range(std::string_view field) {
  if (field == "\u221e" || field == "+\u221e") return beyond;
  if (field == "-\u221e") return -beyond;
  return std::nullopt;
}

}  // namespace

bool is_remark(std::string_view line) {
  return line.empty() || line.front() == ';' || line.front() == '#' || line.front() == '%';
}

std::vector<std::string> fields_of(std::string_view line, char separator) {
  std::vector<std::string> all = parted(line, separator);
  if (separator != ' ') return all;
  std::vector<std::string> fields;
  for (std::string& field : all) {
    if (field.empty()) continue;
    if (is_bracketed(field) && !fields.empty() && !is_bracketed(fields.back()))
      fields.back().append(" ").append(field);
    else
      fields.push_back(std::move(field));
  }
  return fields;
}

std::vector<std::string> without_empty_end(std::vector<std::string> fields) {
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

std::optional<double> cell_of(const std::string& field, bool decimal_comma) {
  if (says_nothing(field)) return no_number;
  if (const auto sign = beyond_range(field)) return sign;
  std::string text = field;
  if (decimal_comma) std::ranges::replace(text, ',', '.');
  const auto number = parse_number(text);
  if (!number || std::abs(*number) < least_beyond || std::isnan(*number)) return number;
  return std::copysign(beyond, *number);
}

bool is_clock_time(std::string_view field) {
  const std::size_t colon = field.find(':');
  return colon != std::string_view::npos && colon > 0 && colon + 1 < field.size() &&
         std::isdigit(static_cast<unsigned char>(field[colon - 1])) != 0 &&
         std::isdigit(static_cast<unsigned char>(field[colon + 1])) != 0;
}

}  // namespace sim
