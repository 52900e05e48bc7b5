#pragma once
// A frame's waveform as characters, about where the pin is first other than what was sent: for a
// terminal, and for pages that show no pictures of others, as a CI server's summary.
#include <string>

#include "sim/check/one_frame.hpp"

namespace sim {

/// Three characters of the message: light, pin, and their bits, two columns a bit; and a line that
/// says where they differ. At most 72 columns wide.
std::string frame_picture(const OneFrame& frame);

}  // namespace sim
