#include "sim/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/stop_rule.hpp"
#include "sim/sweep.hpp"

namespace sim {
namespace {

/// As written with few digits, enough of them for the tolerance; users read and type these values.
double rounded(double value, double tolerance) {
  const int digits = 2 + std::max(0, static_cast<int>(std::ceil(-std::log10(tolerance))));
  return parse_number(fmt::format("{:.{}g}", value, digits)).value_or(value);
}

/// A value about in the middle of two, on a logarithmic axis where that exists; nothing once they
/// are near enough to each other.
std::optional<double> between(double a, double b, const SearchRange& range) {
  const auto [low, high] = std::minmax(a, b);
  const double scale = std::max(std::abs(range.low), std::abs(range.high));
  if (high - low <= range.tolerance * (low > 0 ? high : scale)) return std::nullopt;
  const double exact = low > 0 ? std::sqrt(low) * std::sqrt(high) : low + (high - low) / 2;
  double middle = range.whole_numbers ? std::round(exact) : rounded(exact, range.tolerance);
  if (middle <= low || middle >= high) middle = exact;
  if (range.whole_numbers && middle != std::round(middle)) return std::nullopt;
  return middle;
}

}  // namespace

void search(const SearchRange& range, double flr, const CountAt& count) {
  const auto side_at = [&](double value) {
    const auto counted = count(value);
    return counted ? side_of(*counted, flr) : Side::unknown;
  };
  const Side first = side_at(range.low);
  if (first == Side::unknown) return;
  const Side last = side_at(range.high);
  if (last == Side::unknown || last == first) return;
  double near = range.low, far = range.high;
  while (const auto middle = between(near, far, range)) {
    const Side side = side_at(*middle);
    if (side == Side::unknown) {  // about at the level: its neighbours give a fit the slope
      for (const double end : {near, far})
        if (const auto beside = between(end, *middle, range)) side_at(*beside);
      return;
    }
    (side == first ? near : far) = *middle;
  }
}

}  // namespace sim
