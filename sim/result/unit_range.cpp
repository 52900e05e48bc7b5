#include "sim/result/unit_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sim {
namespace {

/// Of a number of things, the place of that below which a share of them lies.
std::size_t place_of_quantile(double share, std::size_t n) {
  const auto place = static_cast<std::size_t>(std::ceil(share * static_cast<double>(n)));
  return std::clamp<std::size_t>(place, 1, n) - 1;
}

}  // namespace

Axis in_rising_order(Axis axis) {
  std::ranges::sort(axis.values);
  return axis;
}

UnitRange span_of(const RangeQuantiles& quantiles) {
  return {std::min(quantiles.front().low, quantiles.back().low),
          std::max(quantiles.front().high, quantiles.back().high)};
}

UnitRange range_carried(const Axis& axis, std::size_t carried, bool from_above) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t n = axis.values.size();
  if (from_above)
    return {carried == n ? -infinity : axis.values[n - 1 - carried],
            carried == 0 ? infinity : axis.values[n - carried]};
  return {carried == 0 ? -infinity : axis.values[carried - 1],
          carried == n ? infinity : axis.values[carried]};
}

RangeQuantiles range_quantiles(std::vector<UnitRange> ranges, bool from_above) {
  std::ranges::sort(ranges, {}, &UnitRange::low);
  if (from_above) std::ranges::reverse(ranges);
  RangeQuantiles quantiles;
  for (std::size_t q = 0; q < spread_quantiles.size(); ++q)
    quantiles[q] = ranges[place_of_quantile(spread_quantiles[q], ranges.size())];
  return quantiles;
}

}  // namespace sim
