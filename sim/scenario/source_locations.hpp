#pragma once
#include <string>

#include "sim/scenario/scenario.hpp"

namespace sim {

/// Where a key has its value from, for messages: "in x.toml:14", "from the part", "by default".
std::string place_of(const SourceLocations& places, const std::string& key);

}  // namespace sim
