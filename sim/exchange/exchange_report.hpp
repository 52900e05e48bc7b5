#pragma once
// What people and programs read of an exchange.
#include "sim/columns/point_report.hpp"
#include "sim/exchange/exchange_experiment.hpp"

namespace sim {

const Columns<ExchangePoint>& exchange_columns();

extern const PointReport<ExchangePoint> exchange_report;

}  // namespace sim
