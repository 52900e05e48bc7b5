#include "sim/text/row_table.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sim/failure.hpp"
#include "sim/text/existing_file.hpp"
#include "sim/text/json_answer.hpp"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_field(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return quoted(value.get<std::string>());
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());
  return value.dump();
}

std::string rows_as_csv(const std::vector<Json>& rows) {
  std::string text = csv_names(rows.front());
  for (const Json& row : rows) text += csv_line(row);
  return text;
}

std::string rows_as_json_lines(const std::vector<Json>& rows) {
  std::string text;
  for (const Json& row : rows) text += json_line(row);
  return text;
}

bool is_csv(const std::filesystem::path& place) { return place.extension() == ".csv"; }

}  // namespace

std::string csv_names(const Json& row) {
  std::string text;
  for (const auto& [name, value] : row.items()) text += (text.empty() ? "" : ",") + quoted(name);
  return text + "\n";
}

std::string csv_line(const Json& row) {
  std::string text;
  for (const Json& value : row) text += csv_field(value) + ",";
  text.back() = '\n';  // in place of the last comma
  return text;
}

void check_row_table(const std::filesystem::path& place, const OwnFiles& own) {
  if (!is_csv(place) && place.extension() != ".json")
    throw bad_input("cannot write a table into " + place.string(), "its ending names no format",
                    "end the name in .csv or .json (JSON lines)");
  check_place(place, own);
}

std::string row_table(const std::filesystem::path& place, const std::vector<Json>& rows) {
  return is_csv(place) ? rows_as_csv(rows) : rows_as_json_lines(rows);
}

bool begins_as_csv(const std::filesystem::path& path, std::string_view names) {
  return beginning_of(path, names.size()) == names;
}

bool begins_as_json_lines(const std::filesystem::path& path, std::string_view first_name) {
  const std::string begin =
      fmt::format(R"({{"format_version":"{}","{}":)", json_format_version, first_name);
  return beginning_of(path, begin.size()) == begin;
}

}  // namespace sim
