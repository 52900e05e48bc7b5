#pragma once
// Spread over units: what a sweep of receiver.unit says of its other axes. Each unit is a part that
// may be the one in the user's hand: what nobody printed is drawn within its bounds.
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "sim/result/dataset.hpp"
#include "sim/result/result.hpp"
#include "sim/scenario/axis.hpp"

namespace sim {

/// Whether several units are among what is swept.
bool has_units(const std::vector<Axis>& axes);

/// The variable of which a spread is made: the frame loss ratio of a point.
inline constexpr const char* loss_name = "flr";

/// Units at a point of the other axes.
struct UnitShare {
  std::vector<double> coordinates;  // of the other axes
  std::size_t units = 0;            // of which something was counted
  std::size_t carried = 0;          // of which at most the level is lost
};

/// Two neighbours of the swept range between which a unit passes the level. Infinite: below its
/// first value, or beyond its last.
struct UnitRange {
  double low = 0, high = 0;
};

/// Shares of units for which a row of ranges is said.
inline constexpr std::array<double, 3> spread_quantiles{0.1, 0.5, 0.9};
using RangeQuantiles = std::array<UnitRange, 3>;

/// A line along the range, the remaining axes standing still.
struct RangeSpread {
  std::vector<double> others;  // their coordinates
  std::vector<double> units;   // their numbers, in the order of `ranges`
  std::vector<UnitRange> ranges;
  RangeQuantiles quantiles;
};

struct UnitSpread {
  double flr = 0.01;                    // the level
  std::vector<Axis> axes;               // without that of the units
  std::vector<UnitShare> shares;        // of the grid of these axes, row-major
  std::optional<std::size_t> abscissa;  // of these axes, along which the level is passed
  std::vector<RangeSpread> rows;        // of lines that are counted to their ends
};

/// The same axis with its values in rising order.
Axis in_rising_order(Axis axis);

/// The range of a unit that carries at so many values of an axis, which rise, counted from the good
/// end: from above, where more is better.
UnitRange range_carried(const Axis& axis, std::size_t carried, bool from_above);

/// Ranges at spread_quantiles of all units, the worst first. At least one unit.
RangeQuantiles range_quantiles(std::vector<UnitRange> ranges, bool from_above);

/// Of the losses of a sweep's points, row-major; NaN where nothing is counted. Nothing where there
/// are no units.
std::optional<UnitSpread> unit_spread(const std::vector<Axis>& axes,
                                      const std::vector<double>& losses, double flr = 0.01);

/// The same of a result; nothing where it has no losses.
std::optional<UnitSpread> unit_spread(const Dataset& data);
std::optional<UnitSpread> unit_spread(const LinkResult& result);

/// The axes of RangeSpread::others. Of a spread that has rows.
std::vector<Axis> axes_of_rows(const UnitSpread& spread);

}  // namespace sim
