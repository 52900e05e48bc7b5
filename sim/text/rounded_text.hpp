#pragma once
// Numbers with fewer digits. Ends of an interval are rounded outwards, so that it holds as printed
// all that it holds as computed.
#include <string>

namespace sim {

enum class Rounding { nearest, down, up };

/// With so many places behind the point: "0.024".
std::string fixed_text(double value, int places, Rounding rounding = Rounding::nearest);

/// "1.23e-4": the exponent without its padding.
std::string scientific_text(double value, int digits, Rounding rounding = Rounding::nearest);

/// As short as may be, with at most so many digits: "0.5".
std::string significant_text(double value, int digits, Rounding rounding = Rounding::nearest);

}  // namespace sim
