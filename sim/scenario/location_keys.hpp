#pragma once
// The tables [presence] and [location] of a scenario.
#include <vector>

#include "sim/scenario/keys.hpp"

namespace sim {

std::vector<Key> presence_keys();
std::vector<Key> location_keys();

}  // namespace sim
