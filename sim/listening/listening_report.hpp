#pragma once
// What people and programs read of listening.
#include "sim/columns/point_report.hpp"
#include "sim/listening/listening_experiment.hpp"

namespace sim {

const Columns<ListeningPoint>& listening_columns();

extern const PointReport<ListeningPoint> listening_report;

}  // namespace sim
