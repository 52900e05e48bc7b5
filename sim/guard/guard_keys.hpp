#pragma once
#include "sim/scenario/experiment_kind.hpp"

namespace sim {

/// What a scenario may say of a robo-guard, with the keys of [guard].
extern const ExperimentKind guard_kind;

}  // namespace sim
