#pragma once
// What people and programs read of how well a device is located at the points of a sweep.
#include "sim/columns/point_report.hpp"
#include "sim/location/location_experiment.hpp"

namespace sim {

const Columns<LocationPointRun>& location_columns();

extern const PointReport<LocationPointRun> location_report;

}  // namespace sim
