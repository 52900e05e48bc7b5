#pragma once
// What a scenario says of a robo-guard: the serial line by which a robot that goes its way through
// an arena tells a base station what the devices said.
#include "sim/scenario/experiment_kind.hpp"

namespace sim {

struct GuardSettings {
  double line_baud = 9600;
  double byte_error_ratio = 0;                  // bytes of which one bit is wrong
  double outage_every_s = 0, outage_for_s = 1;  // means; 0: the line is always there
  double transmit_every_ms = 200;
  double full_set_every_s = 1;
  double compressed = 1;  // a flag
  double query_age_s = 5;
  double query_timeout_s = 1;
};

/// What a scenario may say of a robo-guard, with the keys of [guard].
extern const ExperimentKind guard_kind;

}  // namespace sim
