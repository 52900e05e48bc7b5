#include "sim/capture/csv_table.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"

namespace sim {
namespace {

constexpr std::size_t most_first_lines = 1000, most_cells_ahead = 1'000'000;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

std::string unquoted(std::string_view field) {
  std::string_view text = trimmed(field);
  while (!text.empty() && text.front() == '"') text.remove_prefix(1);
  while (!text.empty() && text.back() == '"') text.remove_suffix(1);
  return std::string(trimmed(text));
}

/// "2024-05-01T12:00:00.25", "12:00:01.5": a time of day, which is no number.
bool is_clock_time(const std::string& field) {
  const std::size_t colon = field.find(':');
  return colon != std::string::npos && colon > 0 && colon + 1 < field.size() &&
         std::isdigit(static_cast<unsigned char>(field[colon - 1])) != 0 &&
         std::isdigit(static_cast<unsigned char>(field[colon + 1])) != 0;
}

bool says_nothing(const std::string& field) {
  return field == "X" || field == "x" || field == "Z" || field == "z" || field == "-";
}

}  // namespace

CsvTable::CsvTable(std::istream& in, std::string file, std::size_t skip)
    : lines_(in, std::move(file), "give rows of numbers, a column for each wire") {
  read_first_lines(skip);
  find_layout();
  widen_to_names();
  read_head();
  read_ahead();
}

void CsvTable::read_ahead() {
  while (ahead_.size() + columns_.size() <= most_cells_ahead) {
    const auto row = read_row();
    whole_ = !row;
    if (whole_) break;
    ahead_.insert(ahead_.end(), row->begin(), row->end());
    ahead_numbers_.push_back(at_line_);
  }
  if (ahead_.empty()) fail("no row of numbers", "there is nothing to decode");
}

void CsvTable::read_first_lines(std::size_t skip) {
  for (std::size_t i = 0; i < skip; ++i)
    if (!lines_.next()) lines_.fail("--skip-rows", "the file has fewer lines");
  while (first_lines_.size() < most_first_lines) {
    const auto line = lines_.next();
    first_are_all_ = !line;
    if (first_are_all_) break;
    cut_ = lines_.is_cut();
    first_lines_.push_back({lines_.number(), std::string(*line)});
  }
}

std::vector<std::string> CsvTable::fields_of(std::string_view line, char separator) const {
  std::vector<std::string> fields;
  if (separator == ' ') {
    for (const std::string_view field : split(line, ' '))
      if (!trimmed(field).empty()) fields.push_back(unquoted(field));
    return fields;
  }
  for (const std::string_view field : split(line, separator)) fields.push_back(unquoted(field));
  return fields;
}

/// NaN where it says nothing; nothing where it is no cell of a row.
std::optional<double> CsvTable::cell_of(const std::string& field, bool decimal_comma) const {
  if (field.empty() || says_nothing(field)) return nothing;
  std::string text = field;
  if (decimal_comma) std::ranges::replace(text, ',', '.');
  const auto number = parse_number(text);
  if (!number) return std::nullopt;
  return std::isfinite(*number) ? *number : nothing;
}

bool CsvTable::is_finite(const std::string& field, bool decimal_comma) const {
  const auto cell = cell_of(field, decimal_comma);
  return cell && std::isfinite(*cell);
}

/// How a line is a row. It is one with all of its fields, or with those behind the head that stands
/// beside the rows and ends with an empty field.
std::optional<CsvTable::Layout> CsvTable::layout_of(const std::string& line, char separator,
                                                    bool comma) const {
  if (is_remark(line)) return std::nullopt;
  const std::vector<std::string> fields = without_empty_end(fields_of(line, separator));
  const auto is_number = [&](const std::string& field) { return is_finite(field, comma); };
  const bool all = std::ranges::all_of(
      fields, [&](const std::string& field) { return cell_of(field, comma).has_value(); });
  const bool begins = !fields.empty() && !fields.front().empty();
  if (begins && all && std::ranges::any_of(fields, is_number))
    return Layout{separator, comma, 0, fields.size()};
  std::size_t first = fields.size();
  while (first > 0 && is_number(fields[first - 1])) --first;
  if (fields.size() - first < 2 || first == 0 || !fields[first - 1].empty()) return std::nullopt;
  return Layout{separator, comma, first, fields.size() - first};
}

/// The layout of most lines; of several of as many the one of more columns, then that of commas.
void CsvTable::find_layout() {
  using Key = std::tuple<char, bool, std::size_t, std::size_t>;
  std::map<Key, std::size_t> counts;
  for (const auto& [separator, comma] : {std::pair{',', false},
                                         {';', false},
                                         {';', true},
                                         {'\t', false},
                                         {'\t', true},
                                         {' ', false}})
    for (const Line& line : first_lines_)
      if (const auto layout = layout_of(line.text, separator, comma))
        ++counts[{separator, comma, layout->first, layout->count}];
  const auto better = [](const auto& a, const auto& b) {
    const auto& [sep_a, comma_a, first_a, count_a] = a.first;
    const auto& [sep_b, comma_b, first_b, count_b] = b.first;
    return std::tuple(a.second, count_a, !comma_a, sep_a == ',') <
           std::tuple(b.second, count_b, !comma_b, sep_b == ',');
  };
  const auto best = std::ranges::max_element(counts, better);
  if (best == counts.end()) {
    refuse_clock_times();
    at_line_ = lines_.number();
    fail("no row of numbers", "there is nothing to decode");
  }
  std::tie(layout_.separator, layout_.decimal_comma, layout_.first, layout_.count) = best->first;
}

/// A last column of which no row says anything has its name all the same: the head's last line, if
/// it has as many fields as rows have separators for.
void CsvTable::widen_to_names() {
  const std::vector<std::string>* names = nullptr;
  std::vector<std::string> fields;
  for (const Line& line : first_lines_) {
    if (line.text.find("Increment") != std::string::npos) return;  // behind the names of Rigol
    if (layout_.first > 0 || row_of(line.text)) break;
    if (is_remark(line.text)) continue;
    fields = without_empty_end(fields_of(line.text, layout_.separator));
    names = &fields;
  }
  if (names == nullptr || names->size() <= layout_.count) return;
  const Layout narrow =
      std::exchange(layout_, {layout_.separator, layout_.decimal_comma, 0, names->size()});
  const bool is_any_row = std::ranges::any_of(
      first_lines_, [&](const Line& line) { return row_of(line.text).has_value(); });
  if (!is_any_row) layout_ = narrow;
}

void CsvTable::refuse_clock_times() {
  for (const Line& line : first_lines_)
    for (const char separator : {',', ';', '\t'})
      for (const std::string& field : fields_of(line.text, separator)) {
        at_line_ = line.number;
        if (!is_remark(line.text) && is_clock_time(field))
          fail("the time '" + shown(field) + "'", "it is a time of day, and no number of seconds");
      }
}

void CsvTable::read_head() {
  for (std::size_t i = 0; i < first_lines_.size(); ++i) {
    const std::string& line = first_lines_[i].text;
    at_line_ = first_lines_[i].number;
    const bool is_row = row_of(line).has_value();
    if (is_row && layout_.first == 0 && (!head_.has_grid_names() || head_.grid())) {
      first_lines_.erase(first_lines_.begin(),
                         first_lines_.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    }
    const std::vector<std::string> fields = fields_of(line, layout_.separator);
    if (layout_.first == 0)
      head_.read(fields, line, at_line_);
    else if (!fields.empty() && !fields.front().empty())
      head_.read_beside({fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                              fields.size(), layout_.first))},
                        at_line_);
  }
  if (head_.has_grid_names() && !head_.grid())
    fail("no start and increment", "rows are counted by them");
  columns_ = head_.columns(layout_.count);
  if (head_.grid()) columns_.front() = {"time", "", "time"};
}

std::optional<std::vector<double>> CsvTable::row_of(std::string_view line) const {
  if (is_remark(line)) return std::nullopt;
  const std::vector<std::string> all = fields_of(line, layout_.separator),
                                 fields = without_empty_end(all);
  const std::size_t end = layout_.first + layout_.count;
  if (fields.size() > end || all.size() < end) return std::nullopt;
  std::vector<double> row(layout_.count, nothing);
  for (std::size_t i = layout_.first; i < fields.size(); ++i) {
    const auto cell = cell_of(fields[i], layout_.decimal_comma);
    if (!cell) return std::nullopt;
    row[i - layout_.first] = *cell;
  }
  const bool says_something =
      std::ranges::any_of(row, [](double cell) { return std::isfinite(cell); });
  if (fields.size() <= layout_.first || (!says_something && row.size() < 2)) return std::nullopt;
  if (head_.grid()) row.front() = head_.grid()->start + head_.grid()->increment * row.front();
  return row;
}

std::optional<std::string> CsvTable::next_line() {
  if (first_lines_.empty()) {
    const auto line = first_are_all_ ? std::nullopt : lines_.next();
    at_line_ = lines_.number();
    if (!line) return std::nullopt;
    cut_ = lines_.is_cut();
    return std::string(*line);
  }
  Line line = std::move(first_lines_.front());
  first_lines_.pop_front();
  at_line_ = line.number;
  return std::move(line.text);
}

std::optional<std::vector<double>> CsvTable::read_row() {
  while (const auto line = next_line()) {
    if (is_remark(*line) || trimmed(*line).empty()) continue;
    if (auto row = row_of(*line)) return row;
    if (cut_ && first_lines_.empty()) return std::nullopt;
    fail("'" + shown(*line) + "'", "not as many numbers as there are columns");
  }
  return std::nullopt;
}

std::optional<std::vector<double>> CsvTable::next() {
  if (given_ == ahead_numbers_.size()) return read_row();
  const auto cells = std::span(ahead_).subspan(given_ * columns_.size(), columns_.size());
  at_line_ = ahead_numbers_[given_++];
  return std::vector<double>(cells.begin(), cells.end());
}

}  // namespace sim
