#include "sim/exchange/exchange_command.hpp"

#include <fmt/format.h>

#include "sim/dataset.hpp"
#include "sim/exchange/exchange_report.hpp"
#include "sim/outside_report.hpp"
#include "sim/standard_output.hpp"

namespace sim {

void run_exchange_scenario(const ExperimentRun& run) {
  const LoadedScenario& scenario = run.scenario;
  ExchangeOptions options{.threads = run.threads, .interrupt = run.interrupt};
  if (!run.json) {
    print(exchange_header(scenario.sweep));
    options.on_point = [&](const ExchangePoint& point) {
      print(exchange_row(scenario.sweep, point));
    };
  }
  const std::vector<ExchangePoint> points = run_exchanges(scenario, options);
  const Dataset data = exchange_dataset(scenario, run.command, points);
  write_dataset(run.output, data, run.program);
  if (run.json) return print(dataset_json(data) + "\n");
  print(outside_notes(data));
  if (points.size() == 1 && points[0].tally.n_runs > 0) print("\n" + direction_table(points[0]));
  print(fmt::format("{}: digest {}\n", run.output.string(), dataset_digest(data)));
}

}  // namespace sim
