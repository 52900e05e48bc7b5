#pragma once
#include "sim/scenario/experiment_kind.hpp"

namespace sim {

/// What a scenario may say of presence and of location, with the keys of [presence] and [location].
extern const ExperimentKind presence_kind, location_kind;

}  // namespace sim
