#pragma once
#include <vector>

#include "sim/keys.hpp"

namespace sim {

/// Keys of [guard].
std::vector<Key> guard_keys();

}  // namespace sim
