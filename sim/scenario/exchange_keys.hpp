#pragma once
#include <vector>

#include "sim/scenario/keys.hpp"

namespace sim {

/// Keys of [exchange].
std::vector<Key> exchange_keys();

}  // namespace sim
