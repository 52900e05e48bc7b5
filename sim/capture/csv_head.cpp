#include "sim/capture/csv_head.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/capture/csv_fields.hpp"
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
    "sampleinterval", "samplinginterval", "sampleperiod", "samplingperiod", "xincrement",   "xincr",
    "xinc",           "deltat",           "deltax",       "timeincrement",  "timeinterval", "tinc",
    "timestep",       "hresolution"};
constexpr std::string_view names_of_units[] = {
    "timeunit", "timeunits", "horizontalunit", "horizontalunits", "xunit", "xunits", "hunit"};

/// "Maximum sample rate" is not the one of these rows.
template <class Names>
bool is_named(const Names& names, std::string_view key) {
  const std::string letters = letters_of(heading_of(key).name);
  return letters.find("max") == std::string::npos &&
         std::ranges::any_of(names, [&](std::string_view name) { return letters.ends_with(name); });
}

std::string_view without_marks(std::string_view line) {
  while (is_remark(line) && !line.empty()) line.remove_prefix(1);
  return trimmed(line);
}

/// "Samplerate: 1 MHz", "Sample Interval = 1e-6" or "XInc:,1e-6" as key and value; else the first
/// two fields.
std::pair<std::string, std::string> key_and_value(const std::vector<std::string>& fields,
                                                  std::string_view line) {
  const std::size_t at = line.find_first_of(":=");
  const std::string front = fields.empty() ? "" : fields.front();
  if (fields.size() > 1 && (front.ends_with(':') || front.ends_with('=')))
    return {std::string(trimmed(front.substr(0, front.size() - 1))), fields[1]};
  if (at != std::string_view::npos && (fields.size() < 2 || at < front.size()))
    return {std::string(line.substr(0, at)), std::string(trimmed(line.substr(at + 1)))};
  return {front, fields.size() > 1 ? fields[1] : ""};
}

bool are_units(const std::vector<std::string>& fields) {
  return !fields.empty() && std::ranges::all_of(fields, [](const std::string& field) {
    return field.empty() || is_unit_word(field);
  });
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool begins_a_number(std::string_view text) { return text.find_first_of("0123456789+-.") == 0; }

/// Names behind a key: "Source,CH1,CH2".
bool are_sources(const std::vector<std::string>& fields) {
  return !fields.empty() && (fields.front() == "Source" || fields.front() == "TraceName");
}

/// "2026/11/25", "12:00:01.5", and both.
bool is_date_or_time(std::string_view field) {
  return begins_a_number(field) && std::ranges::count_if(field, is_digit) > 3 &&
         field.find_first_of("/:-", 1) != std::string_view::npos &&
         field.find_first_not_of("0123456789/:-. TZ") == std::string_view::npos;
}

/// A value or a time of day is in no line of names; "2" may be the name of a channel.
bool are_names(const std::vector<std::string>& fields) {
  return std::ranges::none_of(fields, [](const std::string& field) {
    const bool is_decimal = field.find_first_of(".eE") != std::string::npos;
    return (is_decimal && parse_number(field)) || is_date_or_time(field);
  });
}

/// The unit of "Sample Interval,4,us"; what follows in a longer line may be the next key, and a
/// number that of another channel.
std::string unit_behind(const std::vector<std::string>& fields) {
  if (fields.size() < 3 || parse_number(fields[2])) return "";
  const bool is_one = fields.size() == 3 || time_unit(fields[2]) || is_unit_word(fields[2]);
  return is_one ? fields[2] : "";
}

/// "t0 = -1e-3" behind the names of Rigol's columns.
bool is_timing_field(const std::string& field) {
  return (field.starts_with("t0") || field.starts_with("tInc")) &&
         field.find('=') != std::string::npos;
}

bool is_other_than_seconds(const std::string& unit) {
  const auto known = time_unit(unit);
  return known && known->value != 1;
}

}  // namespace

void CsvHead::read(const std::vector<std::string>& all, std::string_view line, std::size_t number) {
  if (is_remark(line) && read_remark(line)) return;
  std::vector<std::string> fields = without_empty_end(all);
  if (fields.empty() || read_grid(fields) || read_timing(fields, line, number)) return;
  if (is_remark(line)) {
    fields.front() = without_marks(fields.front());
    const bool is_mark = fields.front().empty() && !all.front().empty();
    if (is_mark) fields.erase(fields.begin());
    remarks_.push_back({std::move(fields), all.size() - (is_mark ? 1 : 0), number});
    return;
  }
  if (fields.front() == "Source" && fields.size() == 2) source_ = fields[1];
  read_timing_fields(fields, number);
  std::size_t width = std::max(all.size(), fields.size());
  for (std::size_t i = 1; i + 1 < fields.size(); ++i)
    if (fields[i] == "Start" && fields[i + 1] == "Increment") {
      grid_field_ = width = i;
      fields.resize(i);
    }
  rows_.push_back({std::move(fields), width, number});
}

void CsvHead::read_beside(const std::vector<std::string>& fields, std::size_t number) {
  if (fields.empty()) return;
  if (fields.size() > 1 && fields.front() == "Source") source_ = fields[1];
  if (is_named(names_of_units, fields.front())) beside_.push_back({fields, fields.size(), number});
  read_timing(fields, fields.front(), number);
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
  return read_timing(key, value, unit_behind(fields), number);
}

/// "tInc = 1.04e-05s" behind the names.
void CsvHead::read_timing_fields(std::vector<std::string>& fields, std::size_t number) {
  for (const std::string& field : fields)
    if (is_timing_field(field)) {
      const auto [key, value] = key_and_value({field}, field);
      read_timing(key, value, "", number);
    }
  std::erase_if(fields, is_timing_field);
}

bool CsvHead::read_timing(const std::string& key, const std::string& value, const std::string& unit,
                          std::size_t number) {
  const bool is_rate = is_named(names_of_rates, key);
  if (!is_rate && !is_named(names_of_intervals, key)) return false;
  if (!begins_a_number(value)) return is_rate && !value.empty();  // "Sample Rate,auto", no heading
  const std::string of_key = heading_of(key).unit;
  const std::string word = !of_key.empty() ? of_key : parse_number(value) ? unit : "";
  if (is_rate) {
    take(parse_sample_rate(value + (parse_number(value) ? word : "")), {value, key, number});
    return true;
  }
  const auto tick = word.empty() ? std::optional(Seconds(1)) : time_unit(word);
  const auto interval = tick ? parse_interval(value, *tick) : std::nullopt;
  const bool is_known = interval && is_sample_rate(Hertz(1 / interval->value));
  take(is_known ? std::optional(Hertz(1 / interval->value)) : std::nullopt,
       {tick ? value : word, key, number});
  return true;
}

void CsvHead::take(std::optional<Hertz> rate, const Unknown& unknown) {
  constexpr double rounding = 0.01;
  if (!rate) {
    unknown_ = unknown;
  } else if (sample_rate_ && std::abs(*rate / *sample_rate_ - 1) > rounding) {
    unknown_ = unknown;
    unknown_->why = "the head has said another rate before";
  } else {
    sample_rate_ = rate;
  }
}

/// sigrok's names stand in its remark; a time may stand before them, and "Trigger" behind.
std::optional<Heading> CsvHead::sigrok_heading(std::size_t column, const Columns& columns,
                                               const NamesAndUnits& rows) const {
  if (channels_.empty() || channels_.size() > columns.count) return std::nullopt;
  const std::size_t more = columns.count - channels_.size();
  const bool has_trigger = rows.names != nullptr
                               ? rows.names->field(columns.count - 1) == "Trigger"
                               : more == 2 || (more == 1 && !columns.first_is_time);
  const std::size_t before = more - std::min<std::size_t>(more, has_trigger ? 1 : 0);
  if (before > 1) return std::nullopt;
  if (column < before)
    return rows.names == nullptr ? std::optional(Heading{"time", "", "time"}) : std::nullopt;
  if (column < before + channels_.size())
    return Heading{channels_[column - before], "", channels_[column - before]};
  return Heading{"Trigger", "", "Trigger"};
}

Heading CsvHead::heading(std::size_t column, const Columns& columns,
                         const NamesAndUnits& rows) const {
  const std::string number = std::to_string(column);
  Heading heading{number, "", number};
  if (rows.names != nullptr) heading = heading_of(rows.names->field(columns.first + column));
  if (rows.names != nullptr && are_sources(rows.names->fields) && columns.first + column == 0)
    heading = {};
  if (column > 0 && columns.count == 2 && !source_.empty()) heading = {source_, "", source_};
  if (auto named = sigrok_heading(column, columns, rows)) heading = *named;
  if (rows.units == nullptr || !heading.unit.empty()) return heading;
  const std::string unit = rows.units->field(columns.first + column);
  heading.unit = heading_of(unit).unit.empty() ? unit : heading_of(unit).unit;
  return heading;
}

CsvHead::NamesAndUnits CsvHead::rows_of(std::size_t count) const {
  NamesAndUnits rows;
  for (const Row& row : rows_) {
    if (!row.has(count)) continue;
    if (are_units(row.fields) && (rows.names != nullptr || count > 1))
      rows.units = &row;
    else if (are_names(row.fields) && (rows.names == nullptr || !are_sources(rows.names->fields)))
      rows.names = &row;
  }
  if (const Row* wide = wide_names(count)) rows.names = wide;
  if (rows.names == nullptr) rows.names = names_in_remarks(count);
  return rows;
}

/// The head's last line, if it has more names than rows have cells: LabVIEW's has Comment behind.
const CsvHead::Row* CsvHead::wide_names(std::size_t count) const {
  if (rows_.empty() || count < 2) return nullptr;
  const Row& last = rows_.back();
  const bool is_wide =
      last.fields.size() > count && names_time(last.fields) && are_names(last.fields);
  return is_wide ? &last : nullptr;
}

/// A remark of as many fields, of several the last that names a time.
const CsvHead::Row* CsvHead::names_in_remarks(std::size_t count) const {
  const Row* names = nullptr;
  for (const Row& row : remarks_)
    if (row.has(count) && are_names(row.fields) && (names == nullptr || names_time(row.fields)))
      names = &row;
  return names;
}

std::size_t CsvHead::line_of_units(const Columns& columns) const {
  const auto [names, units] = rows_of(columns.first + columns.count);
  return units != nullptr ? units->line : names != nullptr ? names->line : 1;
}

std::vector<Heading> CsvHead::columns(const Columns& columns) const {
  const NamesAndUnits rows = rows_of(columns.first + columns.count);
  std::vector<Heading> headings;
  for (std::size_t i = 0; i < columns.count; ++i) headings.push_back(heading(i, columns, rows));
  return headings;
}

std::optional<CsvHead::Unknown> CsvHead::unit_of_no_column(const Columns& columns) const {
  const NamesAndUnits used = rows_of(columns.first + columns.count);
  for (const auto* rows : {&rows_, &remarks_, &beside_})
    for (const Row& row : *rows)
      if (&row != used.names && &row != used.units)
        if (auto unit = unit_in(row)) return unit;
  return std::nullopt;
}

/// Other than seconds, in a row that names no column.
std::optional<CsvHead::Unknown> CsvHead::unit_in(const Row& row) {
  constexpr const char* why = "the unit belongs to no column of these rows";
  const auto [key, value] = key_and_value(row.fields, row.field(0));
  if (is_named(names_of_units, key) && is_other_than_seconds(value))
    return Unknown{value, key, row.line, why};
  for (const std::string& field : row.fields)
    if (const Heading heading = heading_of(field);
        is_time_name(heading.name) && is_other_than_seconds(heading.unit))
      return Unknown{heading.unit, heading.name, row.line, why};
  return std::nullopt;
}

}  // namespace sim
