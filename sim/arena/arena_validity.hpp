#pragma once
// Where an arena leaves the range of a model that it is made of.
#include <cstdint>

#include "sim/arena/arena.hpp"

namespace sim {

/// The limits (sim/link/validity) that the link from any sender leaves where the receiver comes
/// nearest to it, or is farthest from it, with light in reach.
std::uint64_t validity_flags_of(const Scenario& scenario, const Arena& arena);

}  // namespace sim
