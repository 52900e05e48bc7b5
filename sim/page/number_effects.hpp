#pragma once
// Which of what nobody printed moves the range, by the units of a sweep.
#include <string>
#include <vector>

#include "sim/result/unit_spread.hpp"
#include "sim/scenario/scenario.hpp"

namespace sim {

/// A drawn number and the range: medians over the third of the units where the number is lowest,
/// and where it is highest.
struct NumberEffect {
  std::string key, unit;
  double range_at_low = 0, range_at_high = 0;
  double low = 0, high = 0;  // medians of the number in these thirds
  double correlation = 0;    // Spearman's, of number and range over all units
};

/// Those of which the correlation is told from none at 95 %, the strongest first, along the first
/// row of a spread. Fewer than six units tell nothing.
std::vector<NumberEffect> number_effects(const LoadedScenario& scenario, const UnitSpread& spread);

/// The ranges of a row's units as a number each: the middle of the two values of the sweep between
/// which the range ends; what is beyond the sweep stands at its end.
std::vector<double> middles_of(const Axis& axis, const RangeSpread& row);

}  // namespace sim
