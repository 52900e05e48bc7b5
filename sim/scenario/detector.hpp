#pragma once
// The detectors of channel/carrier_detector, by name.
#include <string>
#include <vector>

namespace sim {

enum class Detector {
  synchronous,   // carrier with its phase known
  goertzel,      // power at the carrier's frequency
  dc_difference  // more light than in a window before
};

/// Their names, in the order of the enumeration.
const std::vector<std::string>& detector_names();

}  // namespace sim
