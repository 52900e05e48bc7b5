// The same, of those behind guard.
#include "sim/location/location_keys.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/shared_link/shared_link_keys.hpp"

namespace sim {
namespace {

const KnownExperimentKind more_known[]{KnownExperimentKind(shared_link_kind),
                                       KnownExperimentKind(presence_kind),
                                       KnownExperimentKind(location_kind)};

}  // namespace
}  // namespace sim
