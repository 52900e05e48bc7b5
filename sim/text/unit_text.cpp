#include "sim/text/unit_text.hpp"

namespace sim {

std::string unit_text(const std::string& unit) {
  if (unit == "1") return "";
  return unit == "1e-6" ? "ppm" : unit;
}

std::string with_unit(const std::string& value, const std::string& unit) {
  const std::string text = unit_text(unit);
  return text.empty() ? value : value + " " + text;
}

std::string bracketed_unit(const std::string& unit) {
  const std::string text = unit_text(unit);
  return text.empty() ? "" : "[" + text + "]";
}

}  // namespace sim
