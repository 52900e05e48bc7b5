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

constexpr PointReport<GuardPoint> guard_report{guard_header, guard_row, details, guard_dataset};

}  // namespace

constinit const ExperimentEngine guard_engine = experiment_engine<guard_measurement, guard_report>;

}  // namespace sim
