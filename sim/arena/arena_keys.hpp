#pragma once
// What a scenario says of an arena besides its devices and the receiver's way. Module, LED, floor,
// ambient light, other lights and UART come from the same tables as those of a link.
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/placed_device.hpp"

namespace sim {

struct ArenaSettings {
  double duration_s = unset;  // as long as the way takes
  double runs = 8;            // whole number
};

/// What a scenario may say of an arena, with the keys of [arena].
extern const ExperimentKind arena_kind;

}  // namespace sim
