#pragma once
#include "sim/scenario/experiment_kind.hpp"

namespace sim {

/// What a scenario may say of an arena, with the keys of [arena].
extern const ExperimentKind arena_kind;

}  // namespace sim
