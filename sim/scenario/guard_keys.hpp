#pragma once
#include <vector>

#include "sim/scenario/keys.hpp"

namespace sim {

/// Keys of [guard].
std::vector<Key> guard_keys();

}  // namespace sim
