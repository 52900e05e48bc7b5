#pragma once
// Units on a page: how many carry at each point, and which of what nobody printed moves the range.
#include <vector>

#include "sim/page/number_effects.hpp"
#include "sim/result/unit_spread.hpp"
#include "sim/section/page_section.hpp"

namespace sim {

PageSection units_section(const UnitSpread& spread);

/// A tornado and a table, of the first row of the spread. At least one effect.
PageSection effects_section(const UnitSpread& spread, const std::vector<NumberEffect>& effects);

}  // namespace sim
