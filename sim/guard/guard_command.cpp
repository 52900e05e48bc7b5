#include "sim/guard/guard_command.hpp"

#include "sim/arena/arena_report.hpp"
#include "sim/guard/guard_report.hpp"
#include "sim/point_scenario.hpp"

namespace sim {
namespace {

/// What there is to say of one point more than its row.
std::string details(const LoadedScenario& scenario, const GuardPoint& point) {
  return mirror_table(point) + "\n" + guard_waterfall(point) + "\n" +
         way_table(point_scenario(scenario, point.arena.coordinates), point.arena);
}

}  // namespace

void run_guard_scenario(const ExperimentRun& run) {
  const LoadedScenario& scenario = run.scenario;
  GuardOptions options{.threads = run.threads, .interrupt = run.interrupt};
  Rows rows(run);
  rows.print(guard_header(scenario.sweep));
  options.on_point = [&](const GuardPoint& point) { rows.print(guard_row(scenario.sweep, point)); };
  const std::vector<GuardPoint> points = run_guards(scenario, options);
  const Dataset data = guard_dataset(scenario, run.command, points);
  const bool single = points.size() == 1 && points[0].arena.tally.n_runs > 0;
  conclude(run, rows, data, single ? details(scenario, points[0]) : "");
}

}  // namespace sim
