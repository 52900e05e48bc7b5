#include "sim/exchange/exchange_command.hpp"

#include "sim/exchange/exchange_report.hpp"
#include "sim/report/point_report.hpp"

namespace sim {
namespace {

/// What there is to say of one point more than its row.
std::string details(const LoadedScenario&, const ExchangePoint& point) {
  return direction_table(point);
}

}  // namespace

void run_exchange_scenario(const ExperimentRun& run) {
  report_points<ExchangePoint>(run, {exchange_header, exchange_row, details, exchange_dataset},
                               [&](const OnPoint<ExchangePoint>& on_point) {
                                 return run_exchanges(run.scenario, run.workers, on_point);
                               });
}

}  // namespace sim
