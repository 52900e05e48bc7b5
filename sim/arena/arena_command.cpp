#include "sim/arena/arena_command.hpp"

#include <fmt/format.h>

#include "sim/arena/arena_report.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/report/point_report.hpp"

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

constexpr PointReport<ArenaPoint> arena_report{arena_header, arena_row, details, arena_dataset};

}  // namespace

constinit const ExperimentEngine arena_engine = experiment_engine<arena_measurement, arena_report>;

}  // namespace sim
