#pragma once
// Numbers as cells of a table have them. "-" stands for what is not known, or not finite.
#include <functional>
#include <string>

namespace sim {

using RealText = std::function<std::string(double)>;

/// With so many significant digits, as printf's %g: "0.0123".
RealText significant(int digits);
/// With so many digits behind the point.
RealText fixed(int places);
/// "12.3 %"
std::string percent_text(double share);

}  // namespace sim
