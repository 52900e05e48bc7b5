#pragma once
// A capture of `cosys-sim fit` as it is read: which light the module was shown, and what its output
// did.
#include <cstddef>
#include <optional>
#include <string>

#include "channel/receiver_module.hpp"
#include "sim/command/commands.hpp"
#include "sim/fit/pin_recording.hpp"
#include "sim/fit/plan_text.hpp"

namespace sim {

struct LightReading {
  Plan plan;
  std::string plan_words;                       // where it is from: "the plan plan.txt"
  std::optional<double> first_level_mw_per_m2;  // as the plan says
  std::string wire;                             // of the module's output
  PinRecording recording;
  bool is_of_messages = false;  // the plan is what the module itself reports of messages
  bool is_of_drive = false;     // the plan is what the wire of the LED did
};

/// The capture at that place of the request. Throws Failure(bad_input) for what is none, and where
/// neither a plan nor a wire says what the light was.
LightReading read_light(const FitRequest& request, std::size_t which,
                        const channel::ModuleData& like);

}  // namespace sim
