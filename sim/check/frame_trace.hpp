#pragma once
// One frame, character by character: what was sent, what the receiver's pin made of it, and what
// decoders read.
#include <string>
#include <vector>

#include "sim/check/one_frame.hpp"

namespace sim {

/// What stands in where no decoder says characters.
inline constexpr const char* reference_decoder = "mid-bit";

/// As text for people. A decoder that is a program says no characters.
std::string frame_trace(const OneFrame& frame, const std::vector<const Decoder*>& decoders);

}  // namespace sim
