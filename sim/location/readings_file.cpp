#include "sim/location/readings_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "sim/failure.hpp"
#include "sim/text/list_text.hpp"
#include "sim/text/number_text.hpp"
#include "sim/text/spelling.hpp"
#include "sim/text/text_file.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> required{"x_m", "y_m", "heading_deg"};
/// Exactly one of each pair.
const std::vector<std::pair<std::string, std::string>> either{
    {"irradiance_mw_per_m2", "photocurrent_ua"}, {"sigma", "relative_sigma"}};
/// Both or none; cells may be empty.
const std::vector<std::string> bearing{"bearing_deg", "bearing_sigma_deg"};

std::vector<std::string> all_columns() {
  std::vector<std::string> names = required;
  for (const auto& [one, other] : either) names.insert(names.end(), {one, other});
  names.insert(names.end(), bearing.begin(), bearing.end());
  return names;
}

/// Of any cell: beyond it nothing is a metre, a degree or a light.
constexpr double largest = 1e9;

/// The number of a line's cells by their columns; empty cells are left out.
using Row = std::map<std::string, double>;

/// Spreadsheets begin a file with it.
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

struct Line {
  std::string text, place;  // "in FILE:LINE"
};

std::vector<Line> lines_of(const fs::path& path) {
  std::string text = read_text_file(path, "readings");
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  std::vector<Line> lines;
  int number = 0;
  for (std::string_view line : split(text, '\n')) {
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    line = trimmed(line);
    if (line.empty() || line.starts_with('#')) continue;
    lines.push_back({std::string(line), fmt::format("in {}:{}", path.generic_string(), number)});
  }
  return lines;
}

class Table {
 public:
  explicit Table(const Line& header) {
    for (const std::string_view cell : split(header.text, ','))
      add_column(std::string(trimmed(cell)), header.place);
    for (const std::string& name : required)
      if (!has(name)) throw missing(name, header.place);
    for (const auto& [one, other] : either) check_either(one, other, header.place);
    if (has(bearing[0]) != has(bearing[1]))
      throw missing(bearing[has(bearing[0]) ? 1 : 0], header.place);
  }

  bool has(const std::string& name) const {
    return std::ranges::find(columns_, name) != columns_.end();
  }

  Row row(const Line& line) const {
    const auto cells = split(line.text, ',');
    if (cells.size() != columns_.size())
      throw bad_input(fmt::format("{} cells {}", cells.size(), line.place),
                      fmt::format("there are {} columns", columns_.size()),
                      "write a number for each, leave an unmeasured bearing empty");
    Row row;
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (const auto number = cell(columns_[i], trimmed(cells[i]), line.place))
        row[columns_[i]] = *number;
    return row;
  }

 private:
  static Failure missing(const std::string& name, const std::string& place) {
    return bad_input("no column " + name + " " + place, "a reading needs it", "add it");
  }

  void add_column(const std::string& name, const std::string& place) {
    const std::vector<std::string> known = all_columns();
    if (std::ranges::find(known, name) == known.end())
      throw bad_input(fmt::format("column \"{}\" {}", name, place), "no such column",
                      "did you mean " + nearest(name, known) + "?");
    if (has(name))
      throw bad_input("column " + name + " " + place, "it is there twice", "leave one out");
    columns_.push_back(name);
  }

  void check_either(const std::string& one, const std::string& other,
                    const std::string& place) const {
    if (has(one) != has(other)) return;
    throw bad_input(fmt::format("{} column {} {} {}", has(one) ? "a" : "no", one,
                                has(one) ? "and one" : "nor", other) +
                        " " + place,
                    "a reading has exactly one of them", has(one) ? "leave one out" : "add one");
  }

  static std::optional<double> cell(const std::string& column, std::string_view text,
                                    const std::string& place) {
    if (text.empty() && column.starts_with("bearing")) return std::nullopt;
    const auto number = parse_number(text);
    if (!number || !(std::abs(*number) <= largest))
      throw bad_input(fmt::format("{} = \"{}\" {}", column, text, place),
                      fmt::format("not a number from -{0:g} to {0:g}", largest),
                      "write a number such as 0.25 or leave the line out");
    return number;
  }

  std::vector<std::string> columns_;
};

void refuse_0_and_below(const std::string& column, double value, const std::string& place) {
  if (value > 0) return;
  throw bad_input(fmt::format("{} = {} {}", column, value, place), "it is above 0",
                  "correct it or leave the line out");
}

/// The one column of a pair that the row has, and its number.
Row::value_type one_of(const Row& row, const std::pair<std::string, std::string>& pair) {
  return *(row.contains(pair.first) ? row.find(pair.first) : row.find(pair.second));
}

void set_light(Reading& reading, const Row& row, const channel::PhotodiodeData& photodiode,
               const std::string& place) {
  const double per_w_m2 = channel::photocurrent(photodiode, dsp::WattsPerSquareMetre(1)).value;
  const double unit = row.contains("photocurrent_ua") ? 1e-6 / per_w_m2 : 1e-3;
  const double value = one_of(row, either[0]).second;
  const auto& [sigma_column, sigma] = one_of(row, either[1]);
  refuse_0_and_below(sigma_column, sigma, place);
  reading.irradiance_w_per_m2 = value * unit;
  reading.deviation_w_per_m2 = (row.contains("sigma") ? sigma : sigma * value) * unit;
  if (reading.deviation_w_per_m2 > 0) return;
  throw bad_input(fmt::format("relative_sigma of a reading of {} {}", value, place),
                  "its deviation would not be above 0", "give sigma, in the unit of the reading");
}

void set_bearing(Reading& reading, const Row& row, const std::string& place) {
  if (row.contains(bearing[0]) != row.contains(bearing[1]))
    throw bad_input("half a bearing " + place, "it has a direction and a sigma",
                    "fill both cells or none");
  if (!row.contains(bearing[0])) return;
  refuse_0_and_below(bearing[1], row.at(bearing[1]), place);
  reading.bearing = dsp::degrees(row.at(bearing[0]));
  reading.bearing_deviation = dsp::degrees(row.at(bearing[1]));
}

}  // namespace

MeasuredReadings read_readings(const fs::path& path, const channel::PhotodiodeData& photodiode,
                               double height_m) {
  const std::vector<Line> lines = lines_of(path);
  if (lines.size() < 2)
    throw bad_input("in " + path.generic_string(), "no readings",
                    fmt::format("begin with {},irradiance_mw_per_m2,sigma and a line for each",
                                fmt::join(required, ",")));
  const Table table(lines.front());
  MeasuredReadings measured{.readings = {}, .deviations_are_shares = table.has("relative_sigma")};
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const Row row = table.row(lines[i]);
    Reading reading;
    reading.receiver = {.x = row.at("x_m"),
                        .y = row.at("y_m"),
                        .z = height_m,
                        .yaw = dsp::degrees(row.at("heading_deg")),
                        .elevation = {}};
    set_light(reading, row, photodiode, lines[i].place);
    set_bearing(reading, row, lines[i].place);
    measured.readings.push_back(reading);
  }
  return measured;
}

}  // namespace sim
