#include "sim/columns/cell_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace sim {

RealText significant(int digits) {
  return [digits](double value) {
    return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "-";
  };
}

RealText fixed(int places) {
  return [places](double value) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, places) : "-";
  };
}

std::string percent_text(double share) {
  return std::isfinite(share) ? fmt::format("{:.1f} %", 100 * share) : "-";
}

}  // namespace sim
