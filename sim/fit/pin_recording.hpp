#pragma once
// What a capture says of a module's output: the spells during which the pin is low, which is when
// it reports light.
#include <vector>

namespace sim {

struct PinPulse {
  double start_s = 0, end_s = 0;  // of the low level
};

struct PinRecording {
  std::vector<PinPulse> pulses;   // in the order of time; they do not overlap
  double begin_s = 0, end_s = 0;  // the pin was watched from here to there
  double resolution_s = 0;        // between two samples; 0 where edges are exact
};

}  // namespace sim
