#pragma once
// A point run by all processes of a process group, to the same counts as by one.
#include "sim/engine/engine_options.hpp"

namespace sim {

/// run_point() for options.processes, called by each of its members.
PointResult run_point_together(const Link& link, const StopRule& stop, const EngineOptions& options,
                               const PointResult& before);

}  // namespace sim
