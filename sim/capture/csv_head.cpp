#include "sim/capture/csv_head.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "sim/capture/sample_capture.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;

/// Letters alone, in lower case: "Sample Interval (s)" is "sampleintervals".
std::string letters_of(std::string_view text) {
  std::string letters;
  for (const char c : text)
    if (std::isalpha(static_cast<unsigned char>(c)) != 0)
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

constexpr std::string_view names_of_rates[] = {"samplerate", "samplingrate", "samplefrequency",
                                               "samplingfrequency", "samplespersecond"};
constexpr std::string_view names_of_intervals[] = {
    "sampleinterval", "samplinginterval", "sampleperiod",  "samplingperiod", "xincrement",
    "xincr",          "deltat",           "timeincrement", "tinc",           "timestep"};

template <class Names>
bool is_named(const Names& names, std::string_view key) {
  const std::string letters = letters_of(heading_of(key).name);
  return std::ranges::any_of(names, [&](std::string_view name) { return letters.ends_with(name); });
}

/// "Samplerate: 1 MHz" or "Sample Interval = 1e-6" as key and value; else the first two fields.
std::pair<std::string, std::string> key_and_value(const std::vector<std::string>& fields,
                                                  std::string_view line) {
  const std::size_t at = line.find_first_of(":=");
  if (at != std::string_view::npos && (fields.size() < 2 || at < fields.front().size()))
    return {std::string(line.substr(0, at)), std::string(trimmed(line.substr(at + 1)))};
  return {fields.empty() ? "" : fields.front(), fields.size() > 1 ? fields[1] : ""};
}

std::vector<std::string> without_empty_end(std::vector<std::string> fields) {
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

bool are_units(const std::vector<std::string>& fields) {
  return !fields.empty() && std::ranges::all_of(fields, [](const std::string& field) {
    return field.empty() || is_unit_word(field);
  });
}

bool is_remark_line(std::string_view line) {
  return line.starts_with(';') || line.starts_with('#') || line.starts_with('%');
}

/// "t0 = -1e-3" behind the names of Rigol's columns.
bool is_timing_field(const std::string& field) {
  return (field.starts_with("t0") || field.starts_with("tInc")) &&
         field.find('=') != std::string::npos;
}

}  // namespace

void CsvHead::read(const std::vector<std::string>& all, std::string_view line) {
  if (read_channels(line)) return;
  std::vector<std::string> fields = without_empty_end(all);
  if (fields.empty() || read_grid(fields)) return;
  if (read_timing(fields, line) || is_remark_line(line)) return;
  std::erase_if(fields, is_timing_field);
  for (std::size_t i = 1; i + 1 < fields.size(); ++i)
    if (fields[i] == "Start" && fields[i + 1] == "Increment") {
      grid_field_ = i;
      fields.resize(i);
    }
  rows_.push_back(std::move(fields));
}

void CsvHead::read_beside(const std::vector<std::string>& fields) {
  if (fields.size() > 1 && fields.front() == "Source") source_ = fields[1];
  read_timing(fields, fields.empty() ? "" : fields.front());
}

bool CsvHead::read_channels(std::string_view line) {
  if (!line.starts_with("; Channels (")) return false;
  channels_.clear();
  const std::size_t at = std::min(line.find(": "), line.size() - 1);
  for (const std::string_view name : split(line.substr(at + 1), ','))
    channels_.emplace_back(trimmed(name));
  return true;
}

bool CsvHead::read_grid(const std::vector<std::string>& fields) {
  if (grid_field_ == 0 || grid_ || fields.size() < grid_field_ + 2) return false;
  const auto start = parse_number(fields[grid_field_]),
             increment = parse_number(fields[grid_field_ + 1]);
  if (!start || !increment || !std::isfinite(*start) || *increment <= 0) return false;
  grid_ = {*start, *increment};
  return true;
}

bool CsvHead::read_timing(const std::vector<std::string>& fields, std::string_view line) {
  while (is_remark_line(line)) line.remove_prefix(1);
  const auto [key, value] = key_and_value(fields, trimmed(line));
  const std::string unit = fields.size() > 2 ? fields[2] : "";
  if (is_named(names_of_rates, key)) {
    const auto rate = parse_sample_rate(value + (parse_number(value) ? unit : ""));
    if (rate) sample_rate_ = rate;
    if (!rate) unknown_ = {value, key};
    return true;
  }
  if (!is_named(names_of_intervals, key)) return false;
  take_interval(key, value, unit);
  return true;
}

void CsvHead::take_interval(const std::string& key, const std::string& value,
                            const std::string& unit_field) {
  const std::string of_key = heading_of(key).unit;
  const std::string word = !of_key.empty() ? of_key : parse_number(value) ? unit_field : "";
  const auto unit = word.empty() ? std::optional(Seconds(1)) : time_unit(word);
  const auto interval = unit ? parse_interval(value, *unit) : std::nullopt;
  if (interval && is_sample_rate(dsp::Hertz(1 / interval->value)))
    sample_rate_ = Hertz(1 / interval->value);
  else
    unknown_ = {unit ? value : word, key};
}

Heading CsvHead::heading(std::size_t column, std::size_t count,
                         const std::vector<std::string>* names,
                         const std::vector<std::string>* units) const {
  const std::string number = std::to_string(column);
  Heading heading{number, "", number};
  if (names != nullptr) heading = heading_of((*names)[column]);
  if (column > 0 && !source_.empty()) heading = {source_, "", source_};
  if (channels_.size() == count) heading = {channels_[column], "", channels_[column]};
  if (units == nullptr || !heading.unit.empty()) return heading;
  heading.unit = heading_of((*units)[column]).unit;
  if (heading.unit.empty()) heading.unit = (*units)[column];
  return heading;
}

std::vector<Heading> CsvHead::columns(std::size_t count) const {
  const std::vector<std::string>*names = nullptr, *units = nullptr;
  for (const auto& row : rows_)
    if (row.size() == count)
      (are_units(row) && (names != nullptr || count > 1) ? units : names) = &row;
  std::vector<Heading> columns;
  for (std::size_t i = 0; i < count; ++i) columns.push_back(heading(i, count, names, units));
  return columns;
}

}  // namespace sim
