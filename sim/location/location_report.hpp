#pragma once
// What locating found, for people and for programs.
#include <filesystem>
#include <string>

#include "sim/location/locate.hpp"

namespace sim {

/// A few lines: outcome, places with their ellipses, chi-square.
std::string location_text(const Location& location);

/// One JSON object and a newline; lengths in metres, what is not determined null.
std::string location_json(const Location& location);

/// A row a place, or one row where there is none, for a file of that name (.csv, .json).
std::string location_table(const std::filesystem::path& file, const Location& location);
bool is_location_table(const std::filesystem::path& path);

}  // namespace sim
