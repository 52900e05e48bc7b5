#pragma once
// Keys of [path] and of [devices.NAME], NAME being the user's own.
#include <string>
#include <vector>

#include "sim/scenario/key.hpp"

namespace sim {

std::vector<Key> path_keys();

/// What a table [devices.NAME] may have: keys for a device of this name.
const std::vector<Key>& placed_device_keys(const std::string& name);

/// The key "devices.NAME.WHAT"; nothing if there is none. Not for several threads at once.
const Key* find_placed_device_key(const std::string& name);

}  // namespace sim
