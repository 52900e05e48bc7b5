#pragma once
// The figure of the COSYS protocol's document ("PHYSICAL LAYER": over-the-air waveform above the
// decoded signal) for any trial: its last message, one character of it, and the cycles of light
// where it goes wrong.
#include <string>

#include "sim/trace/trace.hpp"

namespace sim {

/// As SVG. Where no samples were made the light is drawn as it was keyed.
std::string trace_as_picture(const TracedTrial& trial);

/// The same with every tap that was recorded between the light and the pin.
std::string taps_as_picture(const TracedTrial& trial);

}  // namespace sim
