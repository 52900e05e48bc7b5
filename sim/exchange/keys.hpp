#pragma once
#include <vector>

#include "sim/keys.hpp"

namespace sim {

/// Keys of [exchange].
std::vector<Key> exchange_keys();

}  // namespace sim
