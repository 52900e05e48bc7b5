#pragma once
// What people read of a robo-guard, and its columns.
#include <string>

#include "sim/columns/point_report.hpp"
#include "sim/guard/guard_experiment.hpp"

namespace sim {

const Columns<GuardPoint>& guard_columns();

/// From the devices' messages to the base station; adds up.
std::string guard_waterfall(const GuardPoint& point);

extern const PointReport<GuardPoint> guard_report;

}  // namespace sim
