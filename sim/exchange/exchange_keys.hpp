#pragma once
#include "sim/scenario/experiment_kind.hpp"

namespace sim {

/// What a scenario may say of an exchange by SharedLink, with the keys of [exchange].
extern const ExperimentKind exchange_kind;

}  // namespace sim
