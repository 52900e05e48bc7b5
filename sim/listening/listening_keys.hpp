#pragma once
#include "sim/scenario/experiment_kind.hpp"

namespace sim {

/// What a scenario may say of listening, with the keys of [listening].
extern const ExperimentKind listening_kind;

}  // namespace sim
