#include "sim/text/rounded_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace sim {
namespace {

/// Of what was rounded to the nearest step the next one where that is on the wrong side.
double outwards(double nearest, double value, double step, Rounding rounding) {
  if (rounding == Rounding::down && nearest > value) return nearest - step;
  if (rounding == Rounding::up && nearest < value) return nearest + step;
  return nearest;
}

double to_digits(double value, int digits, Rounding rounding) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return value;  // no finite number
  const int exponent = std::stoi(text.substr(e + 1));
  return outwards(std::stod(text), value, std::pow(10, exponent - digits + 1), rounding);
}

}  // namespace

std::string fixed_text(double value, int places, Rounding rounding) {
  const double nearest = std::stod(fmt::format("{:.{}f}", value, places));
  return fmt::format("{:.{}f}", outwards(nearest, value, std::pow(10, -places), rounding), places);
}

std::string scientific_text(double value, int digits, Rounding rounding) {
  if (value == 0) return "0";
  const std::string text = fmt::format("{:.{}e}", to_digits(value, digits, rounding), digits - 1);
  const std::size_t e = text.find('e');
  return fmt::format("{}e{}", text.substr(0, e), std::stoi(text.substr(e + 1)));
}

std::string significant_text(double value, int digits, Rounding rounding) {
  return fmt::format("{:.{}g}", to_digits(value, digits, rounding), digits);
}

}  // namespace sim
