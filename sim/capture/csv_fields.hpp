#pragma once
// The fields of a line of a table, and what a field says as a number.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sim {

/// Whether a line is one to people alone: "; ...", "# ...", "% ...", or empty.
bool is_remark(std::string_view line);

/// Without blanks and quotes around them. A separator between quotes parts nothing (RFC 4180). Of
/// blanks any number is one separator, and a unit in brackets belongs to the word before it.
std::vector<std::string> fields_of(std::string_view line, char separator);

std::vector<std::string> without_empty_end(std::vector<std::string> fields);

/// NaN where it says nothing: empty, X, Z, -, NaN, None, null, N/A. Infinite where the signal was
/// beyond what the instrument can show: inf, an infinity sign, 9.9E+37 (Keysight's). Nothing where
/// it is no cell.
std::optional<double> cell_of(const std::string& field, bool decimal_comma);

/// "2024-05-01T12:00:00.25", "12:00:01.5": a time of day, which is no number.
bool is_clock_time(std::string_view field);

}  // namespace sim
