#pragma once
// What a scenario says of a receiver that listens to a line for hours. Receiver, device and light
// are those of a link.
#include <string>

#include "sim/scenario/experiment_kind.hpp"

namespace sim {

struct FalseAcceptSettings {
  double device_sends = 0;   // a flag
  std::string air = "none";  // or one of sim::disturbance_kinds()
  double duration_s = 60;
  double runs = 60;  // whole number
};

/// What a scenario may say of listening, with the keys of [listening].
extern const ExperimentKind false_accept_kind;

}  // namespace sim
