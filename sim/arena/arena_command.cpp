#include "sim/arena/arena_command.hpp"

#include <fmt/format.h>

#include "sim/arena/arena_report.hpp"
#include "sim/point_scenario.hpp"

namespace sim {
namespace {

/// What there is to say of one point more than its row.
std::string details(const LoadedScenario& scenario, const ArenaPoint& point) {
  const SenderTally all = together(point);
  std::string text =
      device_table(point) + "\n" + waterfall(all.messages(), loss_stages(all), "delivered");
  if (point.tally.n_false > 0)
    text += fmt::format("{:>10}  accepted though nobody sent them\n", point.tally.n_false);
  return text + "\n" + way_table(point_scenario(scenario, point.coordinates), point);
}

}  // namespace

void run_arena_scenario(const ExperimentRun& run) {
  const LoadedScenario& scenario = run.scenario;
  ArenaOptions options{.threads = run.threads, .interrupt = run.interrupt};
  Rows rows(run);
  rows.print(arena_header(scenario.sweep));
  options.on_point = [&](const ArenaPoint& point) { rows.print(arena_row(scenario.sweep, point)); };
  const std::vector<ArenaPoint> points = run_arenas(scenario, options);
  const Dataset data = arena_dataset(scenario, run.command, points);
  const bool single = points.size() == 1 && points[0].tally.n_runs > 0;
  conclude(run, rows, data, single ? details(scenario, points[0]) : "");
}

}  // namespace sim
