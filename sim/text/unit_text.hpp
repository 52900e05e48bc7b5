#pragma once
// Units for people, of those that files have (UDUNITS-2, which calls a pure number "1").
#include <string>

namespace sim {

/// "ppm" of "1e-6", and nothing of a pure number.
std::string unit_text(const std::string& unit);

/// "3 m"
std::string with_unit(const std::string& value, const std::string& unit);

/// "[m]", empty of a pure number.
std::string bracketed_unit(const std::string& unit);

}  // namespace sim
