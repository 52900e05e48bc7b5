#pragma once
// Units on a page: how many carry at each point, and which of what nobody printed moves the range.
#include <optional>
#include <string>
#include <vector>

#include "sim/result/result.hpp"
#include "sim/result/unit_spread.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/section/page_section.hpp"

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

/// Of a link's result; nothing where it has no units.
std::optional<UnitSpread> unit_spread(const LinkResult& result);

PageSection units_section(const UnitSpread& spread);
PageSection effects_section(const UnitSpread& spread, const std::vector<NumberEffect>& effects);

}  // namespace sim
