#include "sim/experiment.hpp"

#include "sim/engine.hpp"
#include "sim/link.hpp"
#include "sim/point_scenario.hpp"
#include "sim/sweep.hpp"

namespace sim {
namespace {

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

PointResult run_one(const Scenario& scenario, std::size_t point, std::size_t n_points,
                    const ExperimentOptions& options) {
  const StopRule stop{
      .max_frames = static_cast<std::uint64_t>(scenario.stop.max_frames),
      .max_frame_errors = static_cast<std::uint64_t>(scenario.stop.max_frame_errors)};
  EngineOptions engine{.threads = options.threads, .interrupt = options.interrupt};
  if (options.on_progress) {
    engine.on_progress = [&](const Tally& tally) {
      options.on_progress({point, n_points, tally, scenario.stop.max_frames});
    };
  }
  return run_point(make_link(scenario), stop, engine);
}

}  // namespace

ExperimentResult run_experiment(const LoadedScenario& scenario, const std::string& command,
                                const ExperimentOptions& options) {
  ExperimentResult result = unfinished(scenario, command);
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    if (options.interrupt != nullptr && *options.interrupt) break;
    PointResult& point = result.points[i];
    const std::vector<double> coordinates = point.coordinates;
    point = run_one(point_scenario(scenario, coordinates), i, result.points.size(), options);
    point.coordinates = coordinates;
    if (options.on_point) options.on_point(result, i);
  }
  return result;
}

}  // namespace sim
