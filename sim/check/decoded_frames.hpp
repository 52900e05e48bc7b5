#pragma once
// Frames of a point as several decoders make them out: the light, the module and its pin are worked
// out once, so a difference between two decoders is one of the decoders alone.
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/check/baseline.hpp"
#include "sim/check/decoder.hpp"
#include "sim/check/delimited_stream.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {

/// So many trials are on one line, from a multiple of it on, whoever decodes them: what a decoder
/// remembers of the frames before is then the same each time, and a program is seldom started.
inline constexpr std::uint32_t frames_per_capture = 128;

struct DecodedFrames {
  std::vector<FrameRecord> frames;
  std::optional<DecoderFault> fault;  // the first
};

/// What each decoder made of trials first ... first + n - 1, or fewer after an interrupt. `first`
/// begins a capture.
std::vector<DecodedFrames> decode_frames(const JudgedLink& judged,
                                         const std::vector<const Decoder*>& decoders,
                                         std::uint32_t first, std::uint32_t n,
                                         const Workers& workers);

}  // namespace sim
