// Makes the experiments known where sim is built without the table of them (COSYS_SIM_UP_TO): those
// up to guard.
#include "sim/arena/arena_keys.hpp"
#include "sim/false_accepts/false_accept_keys.hpp"
#include "sim/guard/guard_keys.hpp"
#include "sim/scenario/experiment_kind.hpp"

namespace sim {
namespace {

const KnownExperimentKind known[]{KnownExperimentKind(arena_kind), KnownExperimentKind(guard_kind),
                                  KnownExperimentKind(false_accept_kind)};

}  // namespace
}  // namespace sim
