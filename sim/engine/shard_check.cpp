#include "sim/engine/shard_check.hpp"

#include <fmt/format.h>

#include <string>

#include "sim/counting/stop_rule.hpp"
#include "sim/failure.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/method.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/threads/parallel_runs.hpp"

namespace sim {
namespace {

/// A shard does not see the ratio of all, and weighted losses cannot be divided.
void check_rule(const Scenario& point, bool counts_losses, const std::string& option) {
  const StopRule rule = rule_of(point.stop);
  if (looks_at_ratio(rule))
    throw bad_input(option, "--rel-ci and --target-flr need the counts of all shards",
                    counts_losses
                        ? "use --max-frames and --max-frame-errors, which can be shared out"
                        : "use " + amount_key(point) + ", which can be shared out");
  if (counts_losses && rule.max_frame_errors > 0 &&
      method_of(point.simulation) == Method::importance)
    throw bad_input(option, "what weighted losses are worth cannot be shared out",
                    "add --max-frame-errors 0");
}

void check_amount(const Scenario& point, const Shard& shard, std::uint32_t group,
                  const std::string& option) {
  const std::uint32_t runs = runs_asked_for(point);
  if (shard.count <= divided_up(runs, group)) return;
  const std::string unit = amount_unit(point);
  throw bad_input(option, fmt::format("{} {} are too few for {} shards", runs, unit, shard.count),
                  fmt::format("use fewer shards or more {}{}", unit,
                              group > 1 ? fmt::format(", at least {} for each", group) : ""));
}

}  // namespace

void check_shard(const LoadedScenario& scenario, const Shard& shard, std::uint32_t group,
                 bool counts_losses) {
  if (shard == Shard{}) return;
  const std::string option = "--shard " + shards_text({shard});
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i) {
    const Scenario point = point_scenario(scenario, point_coordinates(scenario.sweep, i));
    check_rule(point, counts_losses, option);
    check_amount(point, shard, group, option);
  }
}

}  // namespace sim
