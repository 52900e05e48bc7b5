#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "sim/closing_lines.hpp"
#include "sim/commands.hpp"
#include "sim/engine.hpp"
#include "sim/experiment.hpp"
#include "sim/failure.hpp"
#include "sim/keeper.hpp"
#include "sim/plan.hpp"
#include "sim/plan_report.hpp"
#include "sim/progress_line.hpp"
#include "sim/report_json.hpp"
#include "sim/report_table.hpp"
#include "sim/resume.hpp"
#include "sim/scenario.hpp"
#include "sim/standard_output.hpp"
#include "sim/stop_signals.hpp"
#include "sim/store.hpp"
#include "sim/sweep.hpp"

namespace sim {
namespace {

namespace fs = std::filesystem;

fs::path output_of(const RunRequest& request, const fs::path& scenario) {
  const Shard& shard = request.shard;
  fs::path name = scenario.stem();
  if (shard != Shard{}) name.concat(fmt::format("-{}of{}", shard.number, shard.count));
  name.concat(".h5");
  if (!request.output) return name;
  std::error_code error;
  const bool folder = request.scenarios.size() > 1 || fs::is_directory(*request.output, error) ||
                      !request.output->has_filename();
  return folder ? *request.output / name : *request.output;
}

void make_output_folder(const RunRequest& request) {
  if (!request.output || (request.scenarios.size() < 2 && request.output->has_filename())) return;
  std::error_code error;
  fs::create_directories(*request.output, error);
  if (error)
    throw Failure(ExitCode::environment,
                  fmt::format("cannot create the folder {} ({}) choose another place",
                              request.output->string(), error.message()));
}

/// Two scenarios that would write one file are refused before any is run.
void refuse_same_output(const RunRequest& request) {
  for (std::size_t i = 0; i < request.scenarios.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const fs::path path = output_of(request, request.scenarios[i]);
      if (path == output_of(request, request.scenarios[j]))
        throw bad_input(
            fmt::format("{} and {} would both be written to {}", request.scenarios[j].string(),
                        request.scenarios[i].string(), path.string()),
            "they have the same name", "rename one or run them one by one");
    }
  }
}

/// A row may have no place to go, such as a reader that has seen enough: that ends the run, but
/// what was counted is kept.
void print_row(const ExperimentResult& result, std::size_t point, bool theory, Keeper& keeper) {
  try {
    print(table_row(result.axes, result.points[point], result.ci_level, theory));
  } catch (const Failure&) {
    keeper.keep(result);
    throw;
  }
}

int threads_of(const RunRequest& request) {
  return request.threads > 0 ? request.threads : default_threads();
}

/// Nothing counted yet; or what the result file has, where there is one to go on with.
ExperimentResult so_far(const RunRequest& request, const LoadedScenario& scenario,
                        const fs::path& output) {
  ExperimentResult result = unfinished(scenario, request.command);
  result.shards = {request.shard};
  std::error_code error;
  if (request.resume && fs::exists(output, error) && fs::file_size(output, error) > 0)
    resume_from(output, request.program, result);
  return result;
}

void run_scenario(const RunRequest& request, const LoadedScenario& scenario, const fs::path& output,
                  const std::atomic<bool>& interrupt) {
  Keeper keeper(output, request.program);
  ProgressLine progress(!request.quiet);
  const bool theory = has_theory(scenario);
  if (!request.json) print(table_header(scenario.sweep, theory));
  ExperimentOptions options{.threads = threads_of(request), .interrupt = &interrupt};
  options.on_progress = [&](const Progress& p) {
    progress.show(p);
    if (keeper.is_due()) keeper.keep(p.result);
  };
  options.on_point = [&](const ExperimentResult& result, std::size_t point) {
    progress.clear();
    if (keeper.is_due()) keeper.keep(result);
    if (!request.json) print_row(result, point, theory, keeper);
  };
  const ExperimentResult result =
      run_experiment(scenario, so_far(request, scenario, output), options);
  keeper.keep(result);
  print(request.json ? to_json(result) + "\n"
                     : missing_lines(result) + closing_lines(result, output));
}

ExitCode plan(const RunRequest& request, const std::vector<LoadedScenario>& scenarios,
              const std::atomic<bool>& interrupt) {
  for (const LoadedScenario& scenario : scenarios) {
    const int threads = threads_of(request);
    const std::vector<Pilot> pilots = run_pilots(scenario, request.shard, threads, interrupt);
    print(plan_table(scenario.sweep, pilots, threads));
    if (interrupt) return ExitCode::interrupted;
  }
  return ExitCode::done;
}

/// The scenario with as many frames a point as there is time for.
LoadedScenario within_budget(const RunRequest& request, const LoadedScenario& scenario,
                             const std::atomic<bool>& interrupt) {
  const std::string key = "stop.max_frames";
  const auto is_of_frames = [&](const Axis& axis) { return axis.key == key; };
  if (std::ranges::any_of(scenario.sweep, is_of_frames))
    throw bad_input("--time-budget", key + " is swept in " + scenario.path.string(),
                    "leave one of the two out");
  const std::vector<Pilot> pilots = run_pilots(scenario, {}, threads_of(request), interrupt);
  const std::uint64_t frames = frames_within(pilots, request.time_budget_s);
  ScenarioOptions options = request.options;
  options.overrides.push_back(fmt::format("{}={}", key, frames));
  LoadedScenario limited = load_with(options, scenario.path);
  if (!request.quiet)
    say(fmt::format("cosys-sim: {}: as of --max-frames {}\n", scenario.path.string(), frames));
  return limited;
}

}  // namespace

LoadedScenario load_with(const ScenarioOptions& options, const fs::path& scenario) {
  PartRoots roots = {scenario.has_parent_path() ? scenario.parent_path() : fs::path(".")};
  roots.insert(roots.end(), options.parts.begin(), options.parts.end());
  return load_scenario(scenario, options.overrides, roots);
}

ExitCode run_command(const RunRequest& request) {
  refuse_same_output(request);
  std::vector<LoadedScenario> scenarios;
  for (const fs::path& path : request.scenarios)
    scenarios.push_back(load_with(request.options, path));
  for (const LoadedScenario& scenario : scenarios) check_shard(scenario, request.shard);
  const std::atomic<bool>& interrupt = heed_stop_signals();
  if (request.plan) return plan(request, scenarios, interrupt);
  make_output_folder(request);
  for (const fs::path& path : request.scenarios) check_writable(output_of(request, path));
  if (request.time_budget_s > 0)
    for (LoadedScenario& scenario : scenarios)
      scenario = within_budget(request, scenario, interrupt);
  for (std::size_t i = 0; i < scenarios.size() && !interrupt; ++i)
    run_scenario(request, scenarios[i], output_of(request, request.scenarios[i]), interrupt);
  if (!interrupt) return ExitCode::done;
  say("cosys-sim: interrupted (by a signal) what was counted is in the result file; the same "
      "command with --resume goes on\n");
  return ExitCode::interrupted;
}

}  // namespace sim
