#pragma once
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Throws bad_input for what is wrong with an arena at any of its points and the keys alone do not
/// show: no device, two of one name, lists of a way that do not fit together, messages too long
/// for their source, more current than an LED's data have, a receiver that is no module.
void check_arena(const LoadedScenario& scenario);

}  // namespace sim
