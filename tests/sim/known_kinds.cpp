// Makes an experiment known, beside the link, that the address sanitizer's build has
// (COSYS_SIM_UP_TO).
#include "sim/false_accepts/false_accept_keys.hpp"
#include "sim/scenario/experiment_kind.hpp"

namespace sim {
namespace {

const KnownExperimentKind known(false_accept_kind);

}  // namespace
}  // namespace sim
