#include "sim/scenario/source_locations.hpp"

#include "sim/scenario/keys.hpp"

namespace sim {

std::string place_of(const SourceLocations& places, const std::string& key) {
  const auto at = places.find(key);
  if (at != places.end()) return at->second;
  return part_giving(key).empty() ? "by default" : "from the part";
}

}  // namespace sim
