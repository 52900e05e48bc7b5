#include "sim/capture/csv_head.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/capture/sample_capture.hpp"
#include "sim/text/letters.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

using dsp::Hertz;
using dsp::Seconds;

/// Letters alone, in lower case: "Sample Interval (s)" is "sampleintervals".
std::string letters_of(std::string_view text) {
  std::string letters;
  for (const char c : in_lower_case(text))
    if (c >= 'a' && c <= 'z') letters += c;
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

bool are_units(const std::vector<std::string>& fields) {
  return !fields.empty() && std::ranges::all_of(fields, [](const std::string& field) {
    return field.empty() || is_unit_word(field);
  });
}

std::string_view without_marks(std::string_view line) {
  while (is_remark(line) && !line.empty()) line.remove_prefix(1);
  return trimmed(line);
}

bool begins_a_number(std::string_view text) { return text.find_first_of("0123456789+-.") == 0; }

/// The unit of "Sample Interval,4,us"; what follows in a longer line may be the next key.
std::string unit_behind(const std::vector<std::string>& fields) {
  const bool is_one = fields.size() == 3 ||
                      (fields.size() > 3 && (time_unit(fields[2]) || is_unit_word(fields[2])));
  return is_one ? fields[2] : "";
}

/// "t0 = -1e-3" behind the names of Rigol's columns.
bool is_timing_field(const std::string& field) {
  return (field.starts_with("t0") || field.starts_with("tInc")) &&
         field.find('=') != std::string::npos;
}

}  // namespace

bool is_remark(std::string_view line) {
  return line.empty() || line.front() == ';' || line.front() == '#' || line.front() == '%';
}

std::vector<std::string> without_empty_end(std::vector<std::string> fields) {
  while (!fields.empty() && fields.back().empty()) fields.pop_back();
  return fields;
}

void CsvHead::read(const std::vector<std::string>& all, std::string_view line, std::size_t number) {
  remark_.reset();
  if (is_remark(line) && read_remark(line)) return;
  std::vector<std::string> fields = without_empty_end(all);
  if (fields.empty() || read_grid(fields) || read_timing(fields, line, number)) return;
  if (is_remark(line)) {
    fields.front() = without_marks(fields.front());
    remark_ = {std::move(fields), number};
    return;
  }
  std::erase_if(fields, is_timing_field);
  for (std::size_t i = 1; i + 1 < fields.size(); ++i)
    if (fields[i] == "Start" && fields[i + 1] == "Increment") {
      grid_field_ = i;
      fields.resize(i);
    }
  rows_.push_back({std::move(fields), number});
}

void CsvHead::read_beside(const std::vector<std::string>& fields, std::size_t number) {
  if (fields.size() > 1 && fields.front() == "Source") source_ = fields[1];
  read_timing(fields, fields.empty() ? "" : fields.front(), number);
}

bool CsvHead::read_remark(std::string_view line) {
  is_of_sigrok_ = is_of_sigrok_ || line.find("libsigrok") != std::string_view::npos;
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

bool CsvHead::read_timing(const std::vector<std::string>& fields, std::string_view line,
                          std::size_t number) {
  const auto [key, value] = key_and_value(fields, without_marks(line));
  const bool is_rate = is_named(names_of_rates, key);
  if (!is_rate && !is_named(names_of_intervals, key)) return false;
  if (!begins_a_number(value)) return is_rate && !value.empty();  // "Sample Rate,auto", no heading
  if (is_rate)
    take_rate(key, value, unit_behind(fields), number);
  else
    take_interval(key, value, unit_behind(fields), number);
  return true;
}

void CsvHead::take_rate(const std::string& key, const std::string& value, const std::string& unit,
                        std::size_t number) {
  const auto rate = parse_sample_rate(value + (parse_number(value) ? unit : ""));
  if (rate)
    sample_rate_ = rate;
  else
    unknown_ = {value, key, number};
}

void CsvHead::take_interval(const std::string& key, const std::string& value,
                            const std::string& unit_field, std::size_t number) {
  const std::string of_key = heading_of(key).unit;
  const std::string word = !of_key.empty() ? of_key : parse_number(value) ? unit_field : "";
  const auto unit = word.empty() ? std::optional(Seconds(1)) : time_unit(word);
  const auto interval = unit ? parse_interval(value, *unit) : std::nullopt;
  if (interval && is_sample_rate(dsp::Hertz(1 / interval->value)))
    sample_rate_ = Hertz(1 / interval->value);
  else
    unknown_ = {unit ? value : word, key, number};
}

Heading CsvHead::heading(std::size_t column, std::size_t count, const NamesAndUnits& rows) const {
  const std::string number = std::to_string(column);
  Heading heading{number, "", number};
  if (rows.names != nullptr) heading = heading_of(rows.names->fields[column]);
  if (column > 0 && !source_.empty()) heading = {source_, "", source_};
  const std::size_t before = count - std::min(count, channels_.size());  // the time, or none
  if (!channels_.empty() && channels_.size() <= count && before <= 1 && column >= before)
    heading = {channels_[column - before], "", channels_[column - before]};
  if (rows.units == nullptr || !heading.unit.empty()) return heading;
  const std::string& unit = rows.units->fields[column];
  heading.unit = heading_of(unit).unit.empty() ? unit : heading_of(unit).unit;
  return heading;
}

CsvHead::NamesAndUnits CsvHead::rows_of(std::size_t count) const {
  NamesAndUnits rows;
  for (const Row& row : rows_)
    if (row.fields.size() == count)
      (are_units(row.fields) && (rows.names != nullptr || count > 1) ? rows.units : rows.names) =
          &row;
  if (rows.names == nullptr && remark_ && remark_->fields.size() == count) rows.names = &*remark_;
  return rows;
}

std::size_t CsvHead::line_of_units(std::size_t count) const {
  const auto [names, units] = rows_of(count);
  return units != nullptr ? units->line : names != nullptr ? names->line : 1;
}

std::vector<Heading> CsvHead::columns(std::size_t count) const {
  const NamesAndUnits rows = rows_of(count);
  std::vector<Heading> columns;
  for (std::size_t i = 0; i < count; ++i) columns.push_back(heading(i, count, rows));
  return columns;
}

}  // namespace sim
