#pragma once
// What several decoders make of the same frames: the light, the module and its pin are worked out
// once, so a difference between two decoders is one of the decoders alone.
#include <atomic>
#include <cstdint>
#include <vector>

#include "sim/link/link.hpp"

namespace sim {

enum class FrameOutcome : std::uint8_t {
  delivered,  // intact, whatever else came
  lost,       // not delivered
  deceived,   // another message was accepted in its place
};

/// For each of the receivers, in their order, the outcomes of trials first ... first + n - 1: those
/// that a run with this receiver counts. Worth nothing once `*stop` is true.
std::vector<std::vector<FrameOutcome>> frame_outcomes(
    const Link& link, const std::vector<const protocol::UartReceiver*>& receivers,
    std::uint32_t first, int n, const std::atomic<bool>* stop = nullptr);

}  // namespace sim
