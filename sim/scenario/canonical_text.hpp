#pragma once
// Canonical text: the physics of one point as text, which names its random numbers by its hash.
#include <string>

#include "sim/scenario/scenario.hpp"

namespace sim {

/// All that decides the physics, part data included, as names and shortest exact values: equal
/// physics, equal text, wherever the point stands. Without keys that are no physics.
std::string canonical_text(const Scenario& scenario);

}  // namespace sim
