// Makes the experiments known where sim is built without the table of them (COSYS_SIM_UP_TO).
#include "sim/arena/arena_keys.hpp"
#include "sim/exchange/exchange_keys.hpp"
#include "sim/guard/guard_keys.hpp"
#include "sim/listening/listening_keys.hpp"
#include "sim/location/location_keys.hpp"
#include "sim/scenario/experiment_kind.hpp"

namespace sim {
namespace {

const KnownExperimentKind known[]{
    KnownExperimentKind(arena_kind),    KnownExperimentKind(guard_kind),
    KnownExperimentKind(exchange_kind), KnownExperimentKind(presence_kind),
    KnownExperimentKind(location_kind), KnownExperimentKind(listening_kind)};

}  // namespace
}  // namespace sim
