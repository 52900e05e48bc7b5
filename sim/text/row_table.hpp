#pragma once
// Rows with names as a plain table, for spreadsheets and for programs that read no HDF5: CSV or
// JSON lines, as the ending of the file's name says.
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "sim/text/new_file.hpp"

namespace sim {

/// CSV as RFC 4180 has it, of objects that all have the same fields, none of them a list or an
/// object: a line of names, and a line a row. Numbers read back as they are; null is empty.
std::string csv_names(const nlohmann::ordered_json& row);
std::string csv_line(const nlohmann::ordered_json& row);

/// Before the work: throws Failure as check_place does, and for an ending that names no format.
void check_row_table(const std::filesystem::path& place, const OwnFiles& own);

/// At least one row, for NAME.csv or NAME.json: an object a line, each with the version of its
/// format.
std::string row_table(const std::filesystem::path& place,
                      const std::vector<nlohmann::ordered_json>& rows);

/// Whether a file begins as a table of which the first columns have these names.
bool begins_as_csv(const std::filesystem::path& path, std::string_view names);
bool begins_as_json_lines(const std::filesystem::path& path, std::string_view first_name);

}  // namespace sim
