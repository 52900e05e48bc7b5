#include "sim/exchange/exchange_command.hpp"

#include "sim/exchange/exchange_report.hpp"

namespace sim {

void run_exchange_scenario(const ExperimentRun& run) {
  const LoadedScenario& scenario = run.scenario;
  ExchangeOptions options{.threads = run.threads, .interrupt = run.interrupt};
  Rows rows(run);
  rows.print(exchange_header(scenario.sweep));
  options.on_point = [&](const ExchangePoint& point) {
    rows.print(exchange_row(scenario.sweep, point));
  };
  const std::vector<ExchangePoint> points = run_exchanges(scenario, options);
  const Dataset data = exchange_dataset(scenario, run.command, points);
  const bool single = points.size() == 1 && points[0].tally.n_runs > 0;
  conclude(run, rows, data, single ? direction_table(points[0]) : "");
}

}  // namespace sim
