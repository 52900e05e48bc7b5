#include "sim/guard/guard_command.hpp"

#include <fmt/format.h>

#include "sim/arena/arena_report.hpp"
#include "sim/dataset.hpp"
#include "sim/guard/guard_report.hpp"
#include "sim/outside_report.hpp"
#include "sim/standard_output.hpp"

namespace sim {

void run_guard_scenario(const ExperimentRun& run) {
  const LoadedScenario& scenario = run.scenario;
  GuardOptions options{.threads = run.threads, .interrupt = run.interrupt};
  if (!run.json) {
    print(guard_header(scenario.sweep));
    options.on_point = [&](const GuardPoint& point) { print(guard_row(scenario.sweep, point)); };
  }
  const std::vector<GuardPoint> points = run_guards(scenario, options);
  const Dataset data = guard_dataset(scenario, run.command, points);
  write_dataset(run.output, data, run.program);
  if (run.json) return print(dataset_json(data) + "\n");
  print(outside_notes(data));
  if (points.size() == 1 && points[0].arena.tally.n_runs > 0)
    print("\n" + mirror_table(points[0]) + "\n" + guard_waterfall(points[0]) + "\n" +
          way_table(scenario.base, points[0].arena));
  print(fmt::format("{}: digest {}\n", run.output.string(), dataset_digest(data)));
}

}  // namespace sim
