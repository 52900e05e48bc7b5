#pragma once
// Ranges of units: between which two values of a sweep each passes a level, and where most do.
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "sim/scenario/axis.hpp"

namespace sim {

/// Two neighbours of the swept range between which a unit passes the level. Infinite: below its
/// first value, or beyond its last.
struct UnitRange {
  double low = 0, high = 0;
};

/// Shares of units for which a row of ranges is said.
inline constexpr std::array<double, 3> spread_quantiles{0.1, 0.5, 0.9};
using RangeQuantiles = std::array<UnitRange, 3>;

/// From the least to the greatest of them: where 8 of 10 units end.
UnitRange span_of(const RangeQuantiles& quantiles);

/// How far units of a part get of which not all is known.
struct RangeDoubt {
  std::string part;
  std::size_t units = 0;  // that were drawn
  RangeQuantiles quantiles{};
  bool is_measured = false;  // the part, if not all of it
  bool breaks_rule = false;  // the part was found not to do what its model does
};

/// The same axis with its values in rising order.
Axis in_rising_order(Axis axis);

/// The range of a unit that carries at so many values of an axis, which rise, counted from the good
/// end: from above, where more is better.
UnitRange range_carried(const Axis& axis, std::size_t carried, bool from_above);

/// Ranges at spread_quantiles of all units, the worst first. At least one unit.
RangeQuantiles range_quantiles(std::vector<UnitRange> ranges, bool from_above);

}  // namespace sim
