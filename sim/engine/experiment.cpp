#include "sim/engine/experiment.hpp"

#include <fmt/format.h>

#include "sim/engine/engine.hpp"
#include "sim/engine/ordered_runs.hpp"
#include "sim/failure.hpp"
#include "sim/link/link.hpp"
#include "sim/loading/point_scenario.hpp"
#include "sim/result/alarms.hpp"
#include "sim/scenario/experiment_kind.hpp"
#include "sim/scenario/method.hpp"
#include "sim/scenario/sweep.hpp"

namespace sim {
namespace {

bool is_finished(const PointResult& point) {
  return measured(point) && point.stop != StopReason::interrupted;
}

void describe(PointResult& point, const Link& link) {
  point.operating = link.operating;
  point.validity_flags = link.validity_flags;
  point.alarms = own_alarms(point);
}

void run_one(const Scenario& scenario, ExperimentResult& result, std::size_t i,
             const ExperimentOptions& options) {
  const Shard shard = result.shards.front();
  const StopRule rule = rule_of(scenario.stop);
  const StopRule share = share_of(rule, shard);
  const PointResult before = result.points[i];
  const auto set = [&](const PointResult& counted) {
    result.points[i] = counted;
    result.points[i].coordinates = before.coordinates;
    result.points[i].rule = rule;
  };
  EngineOptions engine{.threads = options.threads,
                       .first_trial = trials_of(shard, rule.max_frames).first,
                       .profiled = options.profiled,
                       .processes = options.processes,
                       .interrupt = options.interrupt};
  if (options.on_progress) {
    engine.on_progress = [&](const PointResult& so_far) {
      set(so_far);
      options.on_progress({result, i, share.max_frames});
    };
  }
  const Link link = make_link(scenario);
  if (!is_finished(before)) set(run_point(link, share, engine, before));
  describe(result.points[i], link);
}

void refuse_empty(const Shard& shard, std::uint64_t all, const std::string& unit,
                  const std::string& enough) {
  throw bad_input("--shard " + shards_text({shard}),
                  fmt::format("of {} {} none is left for it", all, unit),
                  fmt::format("use fewer shards or more {}{}", unit, enough));
}

void refuse_shared_look(const StopRule& rule, const Shard& shard, const std::string& remedy) {
  if (looks_at_ratio(rule))
    throw bad_input("--shard " + shards_text({shard}),
                    "--rel-ci and --target-flr need the counts of all shards", remedy);
}

void check_frames(const Scenario& point, const Shard& shard) {
  const StopRule rule = rule_of(point.stop);
  refuse_shared_look(rule, shard,
                     "use --max-frames and --max-frame-errors, which can be shared out");
  if (rule.max_frame_errors > 0 && method_of(point.simulation) == Method::importance)
    throw bad_input("--shard " + shards_text({shard}),
                    "what weighted losses are worth cannot be shared out",
                    "add --max-frame-errors 0");
  if (share_of(rule, shard).max_frames == 0)
    refuse_empty(shard, rule.max_frames, "frames", ", at least eight for each");
}

void check_runs(const Scenario& point, const Shard& shard) {
  refuse_shared_look(rule_of(point.stop), shard,
                     "use " + amount_key(point) + ", which can be shared out");
  const std::uint64_t runs = runs_asked_for(point);
  if (shard.count > runs) refuse_empty(shard, runs, "runs", "");
}

void check_points(const LoadedScenario& scenario, const Shard& shard,
                  void (*check)(const Scenario& point, const Shard&)) {
  if (shard == Shard{}) return;
  for (std::size_t i = 0; i < count_points(scenario.sweep); ++i)
    check(point_scenario(scenario, point_coordinates(scenario.sweep, i)), shard);
}

}  // namespace

bool has_theory(const LoadedScenario& scenario) {
  bool matched = channel::is_matched(scenario.base.module);
  for (const std::vector<Scenario>& variants : scenario.variants)
    for (const Scenario& variant : variants) matched |= channel::is_matched(variant.module);
  return matched;
}

void check_shard_of_frames(const LoadedScenario& scenario, const Shard& shard) {
  check_points(scenario, shard, check_frames);
}

void check_shard_of_runs(const LoadedScenario& scenario, const Shard& shard) {
  check_points(scenario, shard, check_runs);
}

void describe_points(const LoadedScenario& scenario, ExperimentResult& result) {
  for (PointResult& point : result.points)
    if (measured(point)) describe(point, make_link(point_scenario(scenario, point.coordinates)));
  add_row_alarms(result);
}

ExperimentResult run_experiment(const LoadedScenario& scenario, ExperimentResult result,
                                const ExperimentOptions& options) {
  const RunCounters by{{.threads = options.threads, .interrupt = options.interrupt},
                       options.processes};
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    if (by.interrupted()) break;
    run_one(point_scenario(scenario, result.points[i].coordinates), result, i, options);
    if (options.on_point) options.on_point(result, i);
  }
  add_row_alarms(result);
  return result;
}

}  // namespace sim
