#include "sim/report/estimate_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

/// Two digits, or all of a whole number.
std::string bound_text(double high) {
  return high < 1 ? scientific(high, 2) : fmt::format("{:.{}f}", high, high < 10 ? 1 : 0);
}

/// Two, or three where half the interval is at most a tenth of the value.
int digits_supported(const Estimate& e) { return (e.high - e.low) / 2 / e.value <= 0.1 ? 3 : 2; }

constexpr int most_digits = 12;

/// With the places that this many digits of the estimate's value take.
std::string text_of(double v, double value, int digits) {
  if (value < 0.01) return scientific(v, digits);
  const int places = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(value))));
  return fmt::format("{:.{}f}", v, places);
}

}  // namespace

std::string scientific(double value, int digits) {
  if (value == 0) return "0";
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t e = text.find('e');
  return fmt::format("{}e{}", text.substr(0, e), std::stoi(text.substr(e + 1)));
}

std::string estimate_text(const Estimate& e) {
  if (std::isnan(e.value)) return "-";
  if (e.value == 0) return "< " + bound_text(e.high);
  int digits = digits_supported(e);
  const auto text = [&](double v) { return text_of(v, e.value, digits); };
  const auto hidden = [&](double end) { return end != e.value && text(end) == text(e.value); };
  while (digits < most_digits && (hidden(e.low) || hidden(e.high))) ++digits;
  return fmt::format("{} [{}, {}]", text(e.value), text(e.low), text(e.high));
}

}  // namespace sim
