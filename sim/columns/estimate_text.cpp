#include "sim/columns/estimate_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "sim/text/rounded_text.hpp"

namespace sim {
namespace {

/// Two digits, or all of a whole number.
std::string bound_text(double high) {
  return high < 1 ? scientific_text(high, 2, Rounding::up)
                  : fixed_text(high, high < 10 ? 1 : 0, Rounding::up);
}

/// Two, or three where half the interval is at most a tenth of the value.
int digits_supported(const Estimate& e) { return (e.high - e.low) / 2 / e.value <= 0.1 ? 3 : 2; }

/// With the places that this many digits of the estimate's value take.
std::string estimate_words(double v, double value, int digits,
                           Rounding rounding = Rounding::nearest) {
  if (value < 0.01) return scientific_text(v, digits, rounding);
  const int places = std::max(0, digits - 1 - static_cast<int>(std::floor(std::log10(value))));
  return fixed_text(v, places, rounding);
}

std::string with_ends(const Estimate& e, int digits) {
  return fmt::format("{} [{}, {}]", estimate_words(e.value, e.value, digits),
                     estimate_words(e.low, e.value, digits, Rounding::down),
                     estimate_words(e.high, e.value, digits, Rounding::up));
}

/// Whether an end looks like the value.
bool hides_an_end(const Estimate& e, int digits) {
  const auto is_hidden = [&](double end) {
    return end != e.value &&
           estimate_words(end, e.value, digits) == estimate_words(e.value, e.value, digits);
  };
  return is_hidden(e.low) || is_hidden(e.high);
}

}  // namespace

std::string estimate_text(const Estimate& e) {
  if (!std::isfinite(e.value)) return "-";
  if (e.value == 0) return "< " + bound_text(e.high);
  std::string text = with_ends(e, digits_supported(e));
  for (int digits = digits_supported(e) + 1; hides_an_end(e, digits - 1); ++digits) {
    std::string longer = with_ends(e, digits);
    if (std::ssize(longer) > estimate_width) break;
    text = std::move(longer);
  }
  return text;
}

}  // namespace sim
