#pragma once
#include <vector>

#include "sim/scenario/keys.hpp"

namespace sim {

/// Keys of [listening].
std::vector<Key> listening_keys();

}  // namespace sim
