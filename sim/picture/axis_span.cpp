#include "sim/picture/axis_span.hpp"

#include <fmt/format.h>

namespace sim {

std::string AxisSpan::label(double value) const {
  const bool is_power = std::log10(value) == std::round(std::log10(value));
  if (logarithmic_ && is_power && (value < 1e-2 || value > 1e4))
    return fmt::format("1e{:.0f}", std::log10(value));
  return fmt::format("{:g}", value);
}

}  // namespace sim
