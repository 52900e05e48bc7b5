#pragma once
// A plan out of a recording of COSYS messages alone: what the module reports of a message says
// which message it was, and so what light there was while it reported nothing. Messages of which it
// reports nothing are not known of.
#include <cstddef>
#include <string>

#include "sim/fit/pin_recording.hpp"
#include "sim/fit/plan_text.hpp"

namespace sim {

/// How a device sends.
struct MessageLight {
  double carrier_hz = 59e3;
  double baud = 600;
  std::string message{};  // without its checksum; empty: the one that is most often whole
};

struct MessagePlan {
  Plan plan;  // in the recording's time; its levels are all 0
  std::string message;
  std::ptrdiff_t messages = 0;  // of which the module reports the first character
  std::ptrdiff_t whole = 0;     // that can be read
};

/// Throws Failure(bad_input) where no message is found; `file` names the recording.
MessagePlan plan_of_messages(const PinRecording& recording, const MessageLight& light,
                             const std::string& file);

}  // namespace sim
