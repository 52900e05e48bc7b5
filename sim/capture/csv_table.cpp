#include "sim/capture/csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/text/number_text.hpp"

namespace sim {
namespace {

constexpr std::size_t longest_head = 1000;  // lines
constexpr std::string_view blanks = " \t";

std::string_view trimmed(std::string_view text) {
  const auto no_blank = [](char c) { return blanks.find(c) == std::string_view::npos && c != '"'; };
  const auto first = std::ranges::find_if(text, no_blank);
  auto last = text.end();
  while (last != first && !no_blank(*(last - 1))) --last;
  return {first, last};
}

bool is_remark(std::string_view line) {
  return line.empty() || line.front() == ';' || line.front() == '#' || line.front() == '%';
}

char separator_of(std::string_view line) {
  for (const char separator : {';', '\t', ','})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ' ';
}

/// "(ms)", in a row of its own below the names: PicoScope, Siglent.
bool is_unit(std::string_view field) {
  const std::string_view text = trimmed(field);
  return text.starts_with('(') && text.ends_with(')');
}

/// "; Channels (2/2): rx, tx" of sigrok.
std::vector<std::string> sigrok_channels(std::string_view line) {
  std::vector<std::string> names;
  std::string_view rest = line.substr(std::min(line.find(": "), line.size() - 1) + 1);
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    names.emplace_back(trimmed(rest.substr(0, comma)));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return names;
}

}  // namespace

CsvTable::CsvTable(std::istream& in, std::string file)
    : lines_(in, std::move(file), "give rows of numbers, a column for each wire") {
  read_head();
  while (ahead_.size() < rows_ahead) {
    auto row = read_row();
    if (!row) break;
    ahead_.push_back(std::move(*row));
  }
}

void CsvTable::read_head() {
  for (std::size_t count = 0; count < longest_head; ++count) {
    const auto line = lines_.next();
    if (!line) break;
    if (!is_remark(*line)) separator_ = separator_of(*line);
    const auto row = is_remark(*line) || lines_.is_cut() ? std::nullopt : numbers(*line);
    if (row) {
      if (grid_field_ > 0 && !grid_) fail("no start and increment", "rows are counted by them");
      name_columns(row->size());
      ahead_.push_back(*row);
      return;
    }
    read_head_line(*line);
  }
  fail("no row of numbers", "there is nothing to decode");
}

void CsvTable::read_head_line(std::string_view line) {
  const std::size_t rate = line.find("amplerate: ");
  if (rate != std::string_view::npos) {
    sample_rate_ = parse_sample_rate(line.substr(line.find(' ', rate) + 1));
  } else if (line.starts_with("; Channels (")) {
    channels_ = sigrok_channels(line);
  } else if (!is_remark(line)) {
    read_names(line);
  }
}

void CsvTable::read_names(std::string_view line) {
  const auto fields = split(line);
  if (grid_field_ > 0 && !grid_) return read_grid(fields);
  if (!fields.empty() && fields.size() == columns_.size() && std::ranges::all_of(fields, is_unit)) {
    columns_.front() += trimmed(fields.front());  // that of the time
    return;
  }
  columns_.clear();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::string_view name = trimmed(fields[i]),
                           next = i + 1 < fields.size() ? fields[i + 1] : "";
    if (i > 0 && name.starts_with("t0") && name.find('=') != std::string_view::npos) return;
    if (i > 0 && name == "Start" && trimmed(next) == "Increment") {
      grid_field_ = i;
      columns_.front() = "time";
      return;
    }
    columns_.emplace_back(name);
  }
}

void CsvTable::read_grid(const std::vector<std::string_view>& fields) {
  if (fields.size() < grid_field_ + 2) return;
  const auto start = parse_number(std::string(trimmed(fields[grid_field_])));
  const auto increment = parse_number(std::string(trimmed(fields[grid_field_ + 1])));
  if (start && increment && std::isfinite(*start) && *increment > 0) grid_ = {*start, *increment};
}

void CsvTable::name_columns(std::size_t count) {
  if (channels_.size() == count) columns_ = channels_;
  if (columns_.size() == count) return;
  columns_.clear();
  for (std::size_t i = 0; i < count; ++i) columns_.push_back(std::to_string(i));
}

std::vector<std::string_view> CsvTable::split(std::string_view line) const {
  std::vector<std::string_view> fields;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(separator_), line.size());
    if (separator_ != ' ' || end > 0) fields.push_back(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return fields;
}

std::optional<std::vector<double>> CsvTable::numbers(std::string_view line) const {
  std::vector<double> row;
  auto fields = split(line);
  while (!fields.empty() && trimmed(fields.back()).empty()) fields.pop_back();
  for (const std::string_view field : fields) {
    std::string text(trimmed(field));
    if (separator_ == ';') std::ranges::replace(text, ',', '.');  // 0,5 is a half
    const auto number = parse_number(text);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    row.push_back(*number);
  }
  if (row.empty()) return std::nullopt;
  if (grid_) row.front() = grid_->start + grid_->increment * row.front();
  if (!std::isfinite(row.front())) return std::nullopt;
  return row;
}

std::optional<std::vector<double>> CsvTable::read_row() {
  while (const auto line = lines_.next()) {
    if (is_remark(*line)) continue;
    auto row = numbers(*line);
    if (row && row->size() == columns_.size()) return row;
    if (lines_.is_cut()) return std::nullopt;
    fail("'" + shown(*line) + "'", "not as many numbers as there are columns");
  }
  return std::nullopt;
}

std::optional<std::vector<double>> CsvTable::next() {
  if (ahead_.empty()) return read_row();
  std::vector<double> row = std::move(ahead_.front());
  ahead_.pop_front();
  return row;
}

}  // namespace sim
