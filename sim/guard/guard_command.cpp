#include "sim/guard/guard_command.hpp"

#include "sim/arena/arena_report.hpp"
#include "sim/guard/guard_report.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/report/point_report.hpp"

namespace sim {
namespace {

/// What there is to say of one point more than its row.
std::string details(const LoadedScenario& scenario, const GuardPoint& point) {
  return mirror_table(point) + "\n" + guard_waterfall(point) + "\n" +
         way_table(point_scenario(scenario, point.arena.coordinates), point.arena);
}

}  // namespace

void run_guard_scenario(const ExperimentRun& run) {
  report_points<GuardPoint>(run, {guard_header, guard_row, details, guard_dataset},
                            [&](const OnPoint<GuardPoint>& on_point) {
                              return run_guards(run.scenario, run.workers, on_point);
                            });
}

}  // namespace sim
