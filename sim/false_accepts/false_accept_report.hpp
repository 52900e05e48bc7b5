#pragma once
// What people and programs read of listening.
#include "sim/columns/point_report.hpp"
#include "sim/false_accepts/false_accept_experiment.hpp"

namespace sim {

const Columns<FalseAcceptPoint>& false_accept_columns();

extern const PointReport<FalseAcceptPoint> false_accept_report;

}  // namespace sim
