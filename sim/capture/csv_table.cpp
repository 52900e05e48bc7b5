#include "sim/capture/csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <utility>

#include "sim/capture/capture_units.hpp"
#include "sim/capture/csv_fields.hpp"

namespace sim {
namespace {

constexpr std::size_t most_first_lines = 1000, most_cells_ahead = 1'000'000;
constexpr std::size_t most_fields_for_one = 64;  // of a line of the head, for a column
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

CsvTable::CsvTable(std::istream& in, std::string file, std::size_t skip)
    : lines_(in, std::move(file), "give rows of numbers, a column for each wire") {
  read_first_lines(skip);
  find_layout();
  widen_to_names();
  read_head();
  read_ahead();
  name_columns();
}

void CsvTable::read_ahead() {
  while (ahead_.size() + layout_.count <= most_cells_ahead) {
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

/// A row whose first cell is empty begins with a semicolon where semicolons separate.
bool CsvTable::is_remark_of(std::string_view line, char separator) {
  return is_remark(line) && !(separator == ';' && line.starts_with(';'));
}

/// How a line is a row. It is one with all of its fields, or with those behind the head that stands
/// beside the rows and ends with an empty field, or behind a separator at its beginning.
std::optional<CsvTable::Layout> CsvTable::layout_of(const std::string& line, char separator,
                                                    bool comma) {
  if (is_remark_of(line, separator)) return std::nullopt;
  const std::vector<std::string> fields = without_empty_end(fields_of(line, separator));
  const auto is_cell = [&](const std::string& field) { return cell_of(field, comma).has_value(); };
  const auto is_number = [&](const std::string& field) {
    const auto cell = cell_of(field, comma);
    return cell && !std::isnan(*cell);
  };
  const bool begins = !fields.empty() && !fields.front().empty();
  if (begins && std::ranges::all_of(fields, is_cell) && std::ranges::any_of(fields, is_number))
    return Layout{separator, comma, 0, fields.size()};
  std::size_t first = fields.size();
  while (first > 0 && is_number(fields[first - 1])) --first;
  const bool is_one = fields.size() == 2 && first == 1;
  if (first == 0 || !fields[first - 1].empty() || (fields.size() - first < 2 && !is_one))
    return std::nullopt;
  return Layout{separator, comma, first, fields.size() - first};
}

/// The layout of most lines; of several of as many the one of more columns, then one that knows of
/// a separator before the first cell, then that of commas.
void CsvTable::find_layout() {
  using Key = std::tuple<char, bool, std::size_t, std::size_t>;
  std::map<Key, std::size_t> counts;
  for (const auto& [separator, comma] : {std::pair{',', false},
                                         {',', true},
                                         {';', false},
                                         {';', true},
                                         {'\t', false},
                                         {'\t', true},
                                         {' ', false}}) {
    if (!may_separate(separator, comma)) continue;
    for (const Line& line : first_lines_)
      if (const auto layout = layout_of(line.text, separator, comma))
        ++counts[{separator, comma, layout->first, layout->count}];
  }
  // A column that is often empty is no separator before the first cell.
  std::erase_if(counts, [&](const auto& row) {
    const auto& [separator, comma, first, count] = row.first;
    return first == 1 && count == 1 && counts.contains({separator, comma, 0, 2});
  });
  const auto better = [](const auto& a, const auto& b) {
    const auto& [sep_a, comma_a, first_a, count_a] = a.first;
    const auto& [sep_b, comma_b, first_b, count_b] = b.first;
    return std::tuple(a.second, count_a, first_a > 0, !comma_a, sep_a == ',') <
           std::tuple(b.second, count_b, first_b > 0, !comma_b, sep_b == ',');
  };
  const auto best = std::ranges::max_element(counts, better);
  if (best == counts.end()) {
    refuse_clock_times();
    refuse_words();
    at_line_ = lines_.number();
    fail("no row of numbers", "there is nothing to decode");
  }
  std::tie(layout_.separator, layout_.decimal_comma, layout_.first, layout_.count) = best->first;
}

/// One that is in no line separates nothing; decimals with a comma are in quotes where a comma
/// separates.
bool CsvTable::may_separate(char separator, bool comma) const {
  if (separator == ',' && !comma) return true;
  const std::string_view sign = separator == ',' ? "\"," : std::string_view(&separator, 1);
  return std::ranges::any_of(
      first_lines_, [&](const Line& line) { return line.text.find(sign) != std::string::npos; });
}

/// A last column of which no row says anything has its name all the same: the head's last line, if
/// it has as many fields as rows have separators for.
void CsvTable::widen_to_names() {
  const std::vector<std::string>* names = nullptr;
  std::vector<std::string> fields;
  for (const Line& line : first_lines_) {
    if (line.text.find("Increment") != std::string::npos) return;  // behind the names of Rigol
    if (layout_.first > 0 || row_of(line.text)) break;
    if (is_remark_of(line.text, layout_.separator)) continue;
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

/// A line that begins with a number as rows do, and goes on with a word: "0.01,****".
void CsvTable::refuse_words() {
  for (const Line& line : first_lines_)
    for (const char separator : {',', ';', '\t', ' '})
      if (const auto word = word_in_row(fields_of(line.text, separator), false)) {
        at_line_ = line.number;
        fail("'" + shown(*word) + "'", "it is no number");
      }
}

std::optional<std::string> CsvTable::word_in_row(const std::vector<std::string>& fields,
                                                 bool comma) {
  const auto number = fields.size() < 2 ? std::nullopt : cell_of(fields.front(), comma);
  if (!number || std::isnan(*number)) return std::nullopt;
  for (const std::string& field : fields)
    if (!cell_of(field, comma)) return field;
  return std::nullopt;
}

/// Of the lines before the first row those that look like rows must not be taken for names.
void CsvTable::read_head_line(const Line& line) {
  std::vector<std::string> fields = fields_of(line.text, layout_.separator);
  const auto word = word_in_row(fields, layout_.decimal_comma);
  if (word && fields.size() == layout_.first + layout_.count) {
    if (!odd_word_) odd_word_ = {line.number, *word};
    return;
  }
  if (!fields.empty() && !is_remark(line.text)) odd_word_.reset();
  if (fields.size() > most_fields_for_one * (layout_.first + layout_.count)) return;
  if (layout_.decimal_comma)
    for (std::string& field : fields)
      if (cell_of(field, true)) std::ranges::replace(field, ',', '.');
  head_.read(fields, line.text, line.number);
}

void CsvTable::read_head() {
  std::size_t rows = 0;  // lines before the first
  for (; rows < first_lines_.size(); ++rows) {
    at_line_ = first_lines_[rows].number;
    const bool is_row = row_of(first_lines_[rows].text).has_value();
    if (is_row && (!head_.has_grid_names() || head_.grid())) break;
    read_head_line(first_lines_[rows]);
  }
  if (odd_word_) fail_at(odd_word_->first, "'" + shown(odd_word_->second) + "'", "it is no number");
  first_lines_.erase(first_lines_.begin(),
                     first_lines_.begin() + static_cast<std::ptrdiff_t>(rows));
  if (layout_.first > 0) read_head_beside();
  if (head_.has_grid_names() && !head_.grid())
    fail("no start and increment", "rows are counted by them");
}

void CsvTable::read_head_beside() {
  for (const Line& line : first_lines_) {
    std::vector<std::string> fields = fields_of(line.text, layout_.separator);
    if (fields.empty() || fields.front().empty()) continue;
    fields.resize(std::min(fields.size(), layout_.first));
    head_.read_beside(fields, line.number);
  }
}

void CsvTable::name_columns() {
  const std::size_t count = layout_.count;
  bool first_is_time = false;
  for (std::size_t i = 0; i < ahead_.size(); i += count)
    first_is_time |= ahead_[i] != 0 && ahead_[i] != 1 && !std::isnan(ahead_[i]);
  place_ = {layout_.first, count, first_is_time};
  columns_ = head_.columns(place_);
  if (head_.grid()) columns_.front() = {"time", "", "time"};
}

std::optional<std::vector<double>> CsvTable::row_of(std::string_view line) const {
  if (is_remark_of(line, layout_.separator)) return std::nullopt;
  const std::vector<std::string> all = fields_of(line, layout_.separator),
                                 fields = without_empty_end(all);
  const std::size_t end = layout_.first + layout_.count;
  if (fields.size() > end || all.size() < end) return std::nullopt;
  if (layout_.first == 1 && !all.front().empty()) return std::nullopt;
  std::vector<double> row(layout_.count, nothing);
  for (std::size_t i = layout_.first; i < fields.size(); ++i) {
    const auto cell = cell_of(fields[i], layout_.decimal_comma);
    if (!cell) return std::nullopt;
    row[i - layout_.first] = *cell;
  }
  const bool says_something =
      std::ranges::any_of(row, [](double cell) { return !std::isnan(cell); });
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
    if (auto row = row_of(*line)) return row;
    const auto fields = without_empty_end(fields_of(*line, layout_.separator));
    if (is_remark(*line) || fields.empty()) continue;
    if (cut_ && first_lines_.empty()) return std::nullopt;
    const auto word = word_in_row(fields, layout_.decimal_comma);
    if (word && fields.size() == layout_.first + layout_.count)
      fail("'" + shown(*word) + "'", "it is no number");
    if (is_time_name(heading_of(fields.front()).name)) fail_at_second_head(*line);
    fail("'" + shown(*line) + "'", "not as many numbers as there are columns");
  }
  return std::nullopt;
}

/// What a logger had left over before it began anew.
void CsvTable::fail_at_second_head(const std::string& line) const {
  fail_at(at_line_, "'" + shown(line) + "'", "a head of columns stands below rows of numbers",
          "leave out what is above it: --skip-rows " + std::to_string(at_line_ - 1));
}

std::optional<std::vector<double>> CsvTable::next() {
  if (given_ == ahead_numbers_.size()) return read_row();
  const auto cells = std::span(ahead_).subspan(given_ * columns_.size(), columns_.size());
  at_line_ = ahead_numbers_[given_++];
  return std::vector<double>(cells.begin(), cells.end());
}

}  // namespace sim
