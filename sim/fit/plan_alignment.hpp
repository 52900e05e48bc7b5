#pragma once
// Where a plan begins in a recording, and by how much their clocks differ: bursts of the plan that
// come out of the dark, set beside pulses that do.
#include "sim/fit/pin_recording.hpp"
#include "sim/fit/plan_text.hpp"

namespace sim {

struct PlanAlignment {
  double start_s = 0;      // of the plan's time 0, in the recording's time
  double clock_error = 0;  // the recording's time runs so much faster, as a share
  int matched = 0;         // bursts

  double recorded_s(double plan_s) const { return start_s + (1 + clock_error) * plan_s; }
  double plan_s(double recorded_s) const { return (recorded_s - start_s) / (1 + clock_error); }
};

/// Clocks may differ by 3 %. Throws Failure(bad_input) where so few bursts fit that it may be
/// chance.
PlanAlignment align(const Plan& plan, const PinRecording& recording);

}  // namespace sim
