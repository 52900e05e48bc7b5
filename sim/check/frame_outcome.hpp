#pragma once
// What a decoder made of one frame.
#include <cstdint>

namespace sim {

/// As bits, so that files hold them as they are.
struct FrameOutcome {
  bool delivered = false;         // intact, whatever else came
  bool undetected_error = false;  // accepted in its time: another message, or it twice
  bool unknown = false;           // the decoder failed, or lost a marker beside it

  bool lost() const { return !delivered && !unknown; }
  bool operator==(const FrameOutcome&) const = default;
};

struct FrameCounts {
  std::uint64_t frames = 0, lost = 0, undetected_error = 0;

  void add(const FrameOutcome& outcome) {
    ++frames;
    lost += outcome.lost();
    undetected_error += outcome.undetected_error;
  }
};

constexpr std::uint8_t as_bits(const FrameOutcome& outcome) {
  return static_cast<std::uint8_t>((outcome.delivered ? 1U : 0U) |
                                   (outcome.undetected_error ? 2U : 0U) |
                                   (outcome.unknown ? 4U : 0U));
}

constexpr FrameOutcome outcome_of_bits(unsigned bits) {
  return {.delivered = (bits & 1U) != 0,
          .undetected_error = (bits & 2U) != 0,
          .unknown = (bits & 4U) != 0};
}

}  // namespace sim
