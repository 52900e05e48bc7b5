#pragma once
// What --json prints: objects that say of which version of the formats they are.
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace sim {

/// Of all of them, and of the lines of a table in .json: "format_version". Another one says that
/// fields are gone or mean something else; new fields come without.
inline constexpr const char* json_format_version = "1";

/// An object with its version before the other fields, on a line of its own. Bytes that are no
/// UTF-8 are replaced.
std::string json_line(const nlohmann::ordered_json& answer);

/// The same indented, without the end of the last line.
std::string json_page(const nlohmann::ordered_json& answer);

}  // namespace sim
