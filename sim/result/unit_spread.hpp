#pragma once
// Spread over units: what a sweep of receiver.unit says of its other axes. Each unit is a part that
// may be the one in the user's hand: what nobody printed is drawn within its bounds.
#include <cstddef>
#include <optional>
#include <vector>

#include "sim/result/dataset.hpp"
#include "sim/result/result.hpp"
#include "sim/result/unit_range.hpp"
#include "sim/scenario/axis.hpp"

namespace sim {

/// Whether several drawn units are among what is swept. Unit 0, the parts as their files have them,
/// is none, and is left out of all that follows.
bool has_units(const std::vector<Axis>& axes);

/// The axes besides that of the units, which is one of them, and a point's coordinates on them.
std::vector<Axis> without_unit(std::vector<Axis> axes);
std::vector<double> without_unit(const std::vector<Axis>& axes, std::vector<double> coordinates);

/// Points of a sweep, by their numbers, that differ in their unit alone.
struct UnitGroup {
  std::vector<double> coordinates;  // of the other axes
  std::vector<std::size_t> points;
};

/// A group for each point of the other axes, in the order of their grid.
std::vector<UnitGroup> unit_groups(const std::vector<Axis>& axes);

/// The variable of which a spread is made: the frame loss ratio of a point.
inline constexpr const char* loss_name = "flr";

/// Units at a point of the other axes.
struct UnitShare {
  std::vector<double> coordinates;  // of the other axes
  std::size_t units = 0;            // of which something was counted
  std::size_t carried = 0;          // of which at most the level is lost
};

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
