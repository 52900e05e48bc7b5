#pragma once
// What people and programs read of an exchange.
#include "sim/columns/point_report.hpp"
#include "sim/shared_link/shared_link_experiment.hpp"

namespace sim {

const Columns<SharedLinkPoint>& shared_link_columns();

extern const PointReport<SharedLinkPoint> shared_link_report;

}  // namespace sim
