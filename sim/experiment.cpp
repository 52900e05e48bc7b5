#include "sim/experiment.hpp"

#include "sim/engine.hpp"
#include "sim/link.hpp"
#include "sim/point_scenario.hpp"
#include "sim/sweep.hpp"

namespace sim {
namespace {

bool is_finished(const PointResult& point) {
  return measured(point) && point.stop != StopReason::interrupted;
}

void run_one(const Scenario& scenario, ExperimentResult& result, std::size_t i,
             const ExperimentOptions& options) {
  const StopRule stop{
      .max_frames = static_cast<std::uint64_t>(scenario.stop.max_frames),
      .max_frame_errors = static_cast<std::uint64_t>(scenario.stop.max_frame_errors),
      .rel_ci = scenario.stop.rel_ci,
      .target_flr = scenario.stop.target_flr};
  const PointResult before = result.points[i];
  const auto set = [&](const PointResult& counted) {
    result.points[i] = counted;
    result.points[i].coordinates = before.coordinates;
  };
  EngineOptions engine{.threads = options.threads, .interrupt = options.interrupt};
  if (options.on_progress) {
    engine.on_progress = [&](const PointResult& so_far) {
      set(so_far);
      options.on_progress({result, i, scenario.stop.max_frames});
    };
  }
  const Link link = make_link(scenario);
  if (!is_finished(before)) return set(run_point(link, stop, engine, before));
  result.points[i].operating = link.operating;
  result.points[i].outside = link.outside;
}

}  // namespace

ExperimentResult unfinished(const LoadedScenario& scenario, const std::string& command) {
  ExperimentResult result;
  result.title = scenario.base.title;
  result.scenario_toml = scenario.text;
  result.command = command;
  result.seed = static_cast<std::uint64_t>(scenario.base.simulation.seed);
  result.axes = scenario.sweep;
  result.points.resize(count_points(scenario.sweep));
  for (std::size_t i = 0; i < result.points.size(); ++i)
    result.points[i].coordinates = point_coordinates(scenario.sweep, i);
  return result;
}

ExperimentResult run_experiment(const LoadedScenario& scenario, ExperimentResult result,
                                const ExperimentOptions& options) {
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    if (options.interrupt != nullptr && *options.interrupt) break;
    run_one(point_scenario(scenario, result.points[i].coordinates), result, i, options);
    if (options.on_point) options.on_point(result, i);
  }
  return result;
}

}  // namespace sim
