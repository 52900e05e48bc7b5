#include "sim/capture/csv_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sim/capture/text_lines.hpp"
#include "sim/text/letters.hpp"

namespace sim {
namespace {

/// By its name: "Index", "Sample #".
bool counts_rows(const Heading& heading) {
  constexpr std::string_view names[] = {
      "index", "idx",    "sample", "samples", "sample #", "sample no", "n",  "nr", "no",
      "#",     "number", "point",  "points",  "row",      "count",     "id", "seq"};
  return std::ranges::find(names, in_lower_case(heading.name)) != std::end(names);
}

/// Rows that are counted: each cell is one more than that above.
bool counts_by_ones(const CsvTable& table, std::size_t column) {
  for (std::size_t row = 1; row < table.rows_ahead(); ++row)
    if (table.ahead(row, column) != table.ahead(row - 1, column) + 1) return false;
  return true;
}

/// In seconds from the first row on, and the shortest step: a column may be coarse.
struct Course {
  std::vector<double> times;
  double shortest_step = std::numeric_limits<double>::infinity();
  std::size_t steps = 0;
};

Course course_of(const CsvTable& table, std::size_t column) {
  const auto unit = time_unit(table.columns()[column].unit);
  Course course;
  for (std::size_t row = 0; row < table.rows_ahead(); ++row) {
    course.times.push_back((table.ahead(row, column) - table.ahead(0, column)) *
                           (unit ? unit->value : 1));
    if (row == 0) continue;
    const double step = course.times[row] - course.times[row - 1];
    if (step > 0) course.shortest_step = std::min(course.shortest_step, step);
    course.steps += step > 0 ? 1 : 0;
  }
  return course;
}

bool are_the_same(const Course& a, const Course& b) {
  for (std::size_t row = 0; row < a.times.size(); ++row)
    if (std::abs(a.times[row] - b.times[row]) > 1.01 * std::max(a.shortest_step, b.shortest_step))
      return false;
  return true;
}

/// Where the head has a rate, a column without a name is the time only if it goes on at that rate.
bool may_be_seconds(const CsvTable& table, std::size_t column) {
  constexpr double rounding = 0.02;
  const auto rate = table.head().sample_rate();
  if (!rate) return true;
  const std::size_t last = table.rows_ahead() - 1;
  const double span = table.ahead(last, column) - table.ahead(0, column);
  return std::abs(span * rate->value / static_cast<double>(last) - 1) < rounding;
}

/// Of several that tell the time the finest: of those with a unit if there are any.
std::size_t best_time(const CsvTable& table, std::vector<std::size_t> columns) {
  const auto has_unit = [&](std::size_t i) {
    return time_unit(table.columns()[i].unit).has_value();
  };
  if (std::ranges::any_of(columns, has_unit))
    std::erase_if(columns, [&](std::size_t i) { return !has_unit(i); });
  std::size_t best = columns.front();
  Course finest = course_of(table, best);
  for (const std::size_t other : columns) {
    Course course = course_of(table, other);
    if (!are_the_same(course, finest))
      table.fail_at(table.head().line_of_units(table.place()),
                    "'" + shown(table.columns()[best].text) + "' and '" +
                        shown(table.columns()[other].text) + "'",
                    "each tells another time", "keep the columns of one of them");
    if (course.steps > finest.steps) {
      best = other;
      finest = std::move(course);
    }
  }
  return best;
}

}  // namespace

bool is_logic(const CsvTable& table, std::size_t column) {
  for (std::size_t row = 0; row < table.rows_ahead(); ++row) {
    const double cell = table.ahead(row, column);
    if (cell != 0 && cell != 1 && !std::isnan(cell)) return false;
  }
  return true;
}

std::optional<bool> level_in(double cell) {
  return std::isnan(cell) ? std::nullopt : std::optional(cell == 1);
}

std::optional<std::uint64_t> edges_of(const CsvTable& table, std::size_t column) {
  if (!is_logic(table, column)) return std::nullopt;
  std::uint64_t edges = 0;
  std::optional<bool> last;
  for (std::size_t row = 0; row < table.rows_ahead(); ++row) {
    const auto level = level_in(table.ahead(row, column));
    edges += last && level && last != level;
    if (level) last = level;
  }
  return edges;
}

bool is_constant(const CsvTable& table, std::size_t column) {
  std::optional<double> first;
  for (std::size_t row = 0; row < table.rows_ahead(); ++row) {
    const double cell = table.ahead(row, column);
    if (std::isnan(cell)) continue;
    if (first.value_or(cell) != cell) return false;
    first = cell;
  }
  return true;
}

bool rises(const CsvTable& table, std::size_t column) {
  const std::size_t rows = table.rows_ahead();
  for (std::size_t row = 1; row < rows; ++row)
    if (!(table.ahead(row, column) >= table.ahead(row - 1, column))) return false;
  return table.ahead(rows - 1, column) > table.ahead(0, column);
}

bool is_no_line(const CsvTable& table, std::size_t column) {
  const Heading& heading = table.columns()[column];
  return rises(table, column) && !is_logic(table, column) &&
         (counts_rows(heading) || is_of_time(heading) || counts_by_ones(table, column));
}

std::optional<std::size_t> time_column(const CsvTable& table) {
  const std::size_t count = table.columns().size();
  if (count < 2) return std::nullopt;
  std::vector<std::size_t> named, rising;
  for (std::size_t i = 0; i < count; ++i)
    if (is_time_name(table.columns()[i].name) ||
        (is_of_time(table.columns()[i]) && !is_logic(table, i))) {
      named.push_back(i);
      if (rises(table, i)) rising.push_back(i);
    }
  if (!rising.empty()) return best_time(table, std::move(rising));
  const auto by_name = std::ranges::find_if(
      named, [&](std::size_t i) { return is_time_name(table.columns()[i].name); });
  if (by_name != named.end()) return *by_name;
  for (std::size_t i = 0; i < count; ++i)
    if (rises(table, i) && !is_logic(table, i) && !is_no_line(table, i) && may_be_seconds(table, i))
      return i;
  return std::nullopt;
}

bool is_beyond_range(const CsvTable& table, std::size_t column) {
  constexpr std::size_t one_in = 20;
  std::size_t beyond = 0;
  for (std::size_t row = 0; row < table.rows_ahead(); ++row)
    beyond += std::isinf(table.ahead(row, column)) ? 1 : 0;
  return beyond * one_in > table.rows_ahead();
}

}  // namespace sim
