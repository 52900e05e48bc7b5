#pragma once
// What a scenario says of two SharedLink nodes that talk by light. LEDs, modules, floor and range
// are those of a link.
#include "sim/scenario/experiment_kind.hpp"

namespace sim {

struct SharedLinkSettings {
  double variables = 4;         // whole number; each way
  double value_characters = 6;  // whole number
  double change_every_s = 5;    // mean
  double query_every_s = 10;    // mean; 0: no questions
  double query_timeout_s = 3;
  double interval_min_ms = 100, interval_max_ms = 900;
  double quiet_ms = 35;
  double full_set_every_s = 5;
  double compressed = 1;      // a flag
  double own_reflection = 1;  // a flag
  double led_offset_mm = 20;
  double duration_s = 60;
  double runs = 4;  // whole number
};

/// What a scenario may say of an exchange by SharedLink, with the keys of [exchange].
extern const ExperimentKind shared_link_kind;

}  // namespace sim
