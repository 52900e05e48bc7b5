#pragma once
// What locating found, for people and for programs.
#include <string>

#include "sim/location/locate.hpp"

namespace sim {

/// A few lines: outcome, places with their ellipses, chi-square.
std::string location_text(const Location& location);

/// One JSON object and a newline; lengths in metres, what is not determined null.
std::string location_json(const Location& location);

}  // namespace sim
