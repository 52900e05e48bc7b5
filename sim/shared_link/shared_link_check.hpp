#pragma once
#include "sim/scenario/scenario.hpp"

namespace sim {

/// Throws for what is wrong at any point of an exchange's sweep.
void check_shared_link(const LoadedScenario& scenario);

}  // namespace sim
