#include "sim/columns/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "sim/text/unit_text.hpp"

namespace sim {
namespace {

std::size_t widest(const std::vector<std::string>& texts) {
  std::size_t width = 0;
  for (const std::string& text : texts) width = std::max(width, text.size());
  return width;
}

TextColumn axis_column(const Axis& axis) {
  const std::size_t dot = axis.key.rfind('.');
  const std::string table = dot == std::string::npos ? "" : axis.key.substr(0, dot);
  const std::string name = dot == std::string::npos ? axis.key : axis.key.substr(dot + 1);
  const std::string unit = bracketed_unit(axis.unit);
  const int width = static_cast<int>(std::max(widest({table, name, unit}), widest(axis.labels)));
  return {{table, name, unit}, axis.is_text() ? -width : std::max(number_width, width)};
}

}  // namespace

std::vector<TextColumn> axis_columns(const std::vector<Axis>& axes) {
  std::vector<TextColumn> columns;
  for (const Axis& axis : axes) columns.push_back(axis_column(axis));
  return columns;
}

std::vector<std::string> coordinate_texts(const std::vector<Axis>& axes,
                                          const std::vector<double>& coordinates) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < axes.size(); ++i)
    texts.push_back(coordinate_text(axes[i], coordinates[i]));
  return texts;
}

std::string table_line(const std::vector<TextColumn>& columns,
                       const std::vector<std::string>& texts) {
  std::string line;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const int width = columns[i].width;
    line += width < 0 ? fmt::format("{:<{}}  ", texts[i], -width)
                      : fmt::format("{:>{}}  ", texts[i], width);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

int line_width(const std::vector<TextColumn>& columns) {
  constexpr int between = 2;
  int width = -between;
  for (const TextColumn& column : columns) {
    const int names = static_cast<int>(widest({column.names.begin(), column.names.end()}));
    width += between + std::max(std::abs(column.width), names);
  }
  return std::max(width, 0);
}

std::string column_words(const TextColumn& column) {
  std::string words;
  for (const std::string& name : column.names) {
    if (name.empty()) continue;
    const bool goes_on = words.ends_with('-') && std::islower(name.front()) != 0;
    if (goes_on) words.pop_back();
    words += (goes_on || words.empty() ? "" : " ") + name;
  }
  words.erase(std::min(words.size(), words.find('[')));
  words.erase(words.find_last_not_of(' ') + 1);
  return words;
}

std::string table_head(const std::vector<TextColumn>& columns) {
  std::string head;
  for (std::size_t row = 0; row < 3; ++row) {
    std::vector<std::string> texts;
    for (const TextColumn& column : columns) texts.push_back(column.names[row]);
    const bool empty = std::ranges::all_of(texts, [](const auto& text) { return text.empty(); });
    if (!empty || row > 0) head += table_line(columns, texts);
  }
  return head;
}

std::string text_table(std::vector<TextColumn> columns,
                       const std::vector<std::vector<std::string>>& rows) {
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (const std::vector<std::string>& row : rows)
      if (columns[i].width < 0)
        columns[i].width = std::min(columns[i].width, -static_cast<int>(row[i].size()));
  std::string table = table_head(columns);
  for (const std::vector<std::string>& row : rows) table += table_line(columns, row);
  return table;
}

}  // namespace sim
