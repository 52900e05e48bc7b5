#pragma once
// One frame, character by character: what was sent, what the receiver's pin made of it, and what
// decoders read.
#include <string>
#include <vector>

#include "sim/check/decoder.hpp"
#include "sim/check/judged_point.hpp"

namespace sim {

/// A frame on the line that decoders are judged by, so that they meet it as they do there.
struct OneFrame {
  JudgedLink judged;
  DelimitedStream line;
  std::size_t index = 0;  // of line.frames

  const FrameOnLine& frame() const { return line.frames[index]; }
  std::uint32_t trial() const { return line.first + static_cast<std::uint32_t>(index); }
};
OneFrame hear_frame(const JudgedPoint& point, std::uint32_t trial);

FrameOutcome outcome_of(const Decoder& decoder, const OneFrame& frame);

/// As text for people. A decoder that is a program says no characters.
std::string frame_trace(const OneFrame& frame, const std::vector<const Decoder*>& decoders);

}  // namespace sim
