#pragma once
// What a link says of its points.
#include "sim/columns/point_report.hpp"
#include "sim/result/result.hpp"

namespace sim {

extern const PointReport<LinkPoint> link_report;

}  // namespace sim
