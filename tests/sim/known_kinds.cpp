// Makes the experiments known where sim is built without the table of them (COSYS_SIM_UP_TO), in
// the order of that table.
#include "sim/arena/arena_keys.hpp"
#include "sim/false_accepts/false_accept_keys.hpp"
#include "sim/guard/guard_keys.hpp"
#include "sim/location/location_keys.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/shared_link/shared_link_keys.hpp"

namespace sim {
namespace {

const KnownExperimentKind known[]{
    KnownExperimentKind(arena_kind),       KnownExperimentKind(guard_kind),
    KnownExperimentKind(shared_link_kind), KnownExperimentKind(presence_kind),
    KnownExperimentKind(location_kind),    KnownExperimentKind(false_accept_kind)};

}  // namespace
}  // namespace sim
