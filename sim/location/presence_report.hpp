#pragma once
// What people and programs read of presence at the points of a sweep.
#include "sim/columns/point_report.hpp"
#include "sim/location/presence_experiment.hpp"

namespace sim {

const Columns<PresencePointRun>& presence_columns();

extern const PointReport<PresencePointRun> presence_report;

}  // namespace sim
