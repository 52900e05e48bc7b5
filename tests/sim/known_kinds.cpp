// Makes the experiments known that the address sanitizer's build has (COSYS_SIM_UP_TO), in the
// order of the table that the program has of all.
#include "sim/arena/arena_keys.hpp"
#include "sim/false_accepts/false_accept_keys.hpp"
#include "sim/guard/guard_keys.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/shared_link/shared_link_keys.hpp"

namespace sim {
namespace {

const KnownExperimentKind known[]{KnownExperimentKind(arena_kind), KnownExperimentKind(guard_kind),
                                  KnownExperimentKind(shared_link_kind),
                                  KnownExperimentKind(false_accept_kind)};

}  // namespace
}  // namespace sim
