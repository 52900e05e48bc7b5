#pragma once
// Numbers with units, as people write them: "3m", "300 cm", "1.2MHz".
#include <string>
#include <string_view>

namespace sim {

/// Whether a text, a range or a list has a unit in it: "1:20m".
bool has_unit(std::string_view text);

/// The same numbers, range or list in `unit`, and without one: "1m:50cm:3m" in m is "1:0.5:3". A
/// unit behind the last number alone is that of all. Units are those that keys have
/// ("m", "W/m2", "degree"), what people write for them ("W/m^2", "deg", "lux", "min"), and their
/// decimal multiples. A text without units stays as it is. Throws bad_input for a unit that is none
/// of `unit`; `problem` opens the error line.
std::string in_unit(std::string_view text, const std::string& unit, const std::string& problem);

}  // namespace sim
