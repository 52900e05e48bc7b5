#pragma once
// Bytes of a line as text for people: on one line, and so that a terminal shows each of them.
#include <string>
#include <string_view>

namespace sim {

/// Bytes that a terminal cannot show, as \xNN; a backslash as two.
std::string escaped(std::string_view text);

/// The same of a name: letters of UTF-8 are kept that a terminal shows as such.
std::string escaped_name(std::string_view text);

}  // namespace sim
