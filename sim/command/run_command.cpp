#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "sim/command/commands.hpp"
#include "sim/command/experiments.hpp"
#include "sim/command/run_plan.hpp"
#include "sim/engine/checkpointer.hpp"
#include "sim/engine/engine.hpp"
#include "sim/engine/experiment.hpp"
#include "sim/engine/process_group.hpp"
#include "sim/engine/progress_line.hpp"
#include "sim/engine/resume.hpp"
#include "sim/failure.hpp"
#include "sim/loading/load_scenario.hpp"
#include "sim/report/closing_lines.hpp"
#include "sim/report/experiment_run.hpp"
#include "sim/report/finished_result.hpp"
#include "sim/report/report_json.hpp"
#include "sim/report/report_table.hpp"
#include "sim/report/result_charts.hpp"
#include "sim/result/store.hpp"
#include "sim/result/unfinished.hpp"
#include "sim/scenario/scenario.hpp"
#include "sim/scenario/sweep.hpp"
#include "sim/text/digest.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/threads/stop_signals.hpp"

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
void print_row(const ExperimentResult& result, std::size_t point, bool theory,
               const std::function<void(const ExperimentResult&)>& keep) {
  try {
    print(table_row(result.axes, result.points[point], result.ci_level, theory));
  } catch (const Failure&) {
    keep(result);
    throw;
  }
}

bool is_gone_on_with(const RunRequest& request, const fs::path& output) {
  std::error_code error;
  return request.resume && fs::exists(output, error) && fs::file_size(output, error) > 0;
}

/// Nothing counted yet; or what the result file has, where there is one to go on with.
ExperimentResult so_far(const RunRequest& request, const LoadedScenario& scenario,
                        const fs::path& output) {
  ExperimentResult result = unfinished(scenario, request.command);
  result.shards = {request.shard};
  if (is_gone_on_with(request, output)) resume_from(output, request.program, result);
  return result;
}

/// A scenario to be run.
struct Run {
  LoadedScenario scenario;
  fs::path output;
  ExperimentResult result{};               // of a link: before its first trial, or gone on with
  std::vector<std::string> checkpoints{};  // of other experiments: what is gone on with
};

/// Whether this process prints and writes.
bool speaks(const ProcessGroup* processes) {
  return processes == nullptr || processes->rank() == 0;
}

std::string profile_of(const ExperimentResult& result) {
  Profile profile;
  std::uint64_t samples = 0;
  for (const PointResult& point : result.points) {
    profile += point.profile;
    samples += point.n_samples;
  }
  return profile_lines(profile, samples);
}

void run_scenario(const RunRequest& request, const Run& run, ExperimentOptions options) {
  Checkpointer checkpointer;
  const auto keep = [&](const ExperimentResult& result) {
    checkpointer.keep([&] { write_result(run.output, result, request.program); });
  };
  const auto keep_all = [&](const ExperimentResult& result) {
    keep_finished(
        run.output, [&](const fs::path& place) { write_result(place, result, request.program); },
        [&] { return to_json(result); });
  };
  ProgressLine progress(!request.quiet);
  const bool theory = has_theory(run.scenario);
  if (!request.json) print(table_header(run.scenario.sweep, theory));
  options.on_progress = [&](const Progress& p) {
    progress.show(status_of(p));
    if (checkpointer.is_due()) keep(p.result);
  };
  options.on_point = [&](const ExperimentResult& result, std::size_t point) {
    progress.clear();
    if (checkpointer.is_due_at_end()) keep(result);
    if (!request.json) print_row(result, point, theory, keep_all);
  };
  const ExperimentResult result = run_experiment(run.scenario, run.result, options);
  keep_all(result);
  if (request.profile) say(profile_of(result));
  if (request.json) return print_json(to_json(result) + "\n");
  print((request.plot ? charts_as_text(result_charts(result)) : "") + missing_lines(result) +
        closing_lines(result, run.output));
}

// ---- experiments that are no links ----

/// What such a run would not heed.
void refuse_link_options(const RunRequest& request, const fs::path& scenario) {
  const std::string where = " with " + scenario.string();
  if (request.profile)
    throw bad_input("--profile" + where, "it times the stages of a link's trial", "leave it out");
}

void run_other(const RunRequest& request, const Run& run, const ExperimentEngine& engine,
               ProcessGroup* processes) {
  engine.run(
      {.scenario = run.scenario,
       .output = run.output,
       .command = request.command,
       .program = request.program,
       .workers = {.threads = threads_for(request.threads), .interrupt = &heed_stop_signals()},
       .processes = processes,
       .json = request.json,
       .quiet = request.quiet,
       .plot = request.plot,
       .checkpoints = run.checkpoints,
       .shards = {request.shard}});
}

/// Of one scenario.
void refuse_options(const RunRequest& request, const Run& run) {
  check_shard(run.scenario, request.shard);
  if (engine_of(run.scenario) != nullptr) refuse_link_options(request, run.scenario.path);
}

/// What a run starts from.
void set_start(const RunRequest& request, Run& run) {
  if (request.time_budget_s > 0)
    run.scenario = within_budget(request, run.scenario, heed_stop_signals());
  if (engine_of(run.scenario) == nullptr) {
    run.result = so_far(request, run.scenario, run.output);
  } else if (is_gone_on_with(request, run.output)) {
    run.checkpoints = {
        checkpoint_to_resume(run.output, request.program, run.scenario, request.shard)};
  }
}

/// Everything that can be refused before the first trial.
std::vector<Run> prepare(const RunRequest& request, ProcessGroup* processes) {
  if (processes != nullptr && (request.plan || request.time_budget_s > 0))
    throw bad_input("--plan and --time-budget", "they time one process, not a job of several",
                    "run them without mpirun");
  refuse_same_output(request);
  std::vector<Run> runs;
  for (const fs::path& path : request.scenarios) {
    runs.push_back({load_with(request.options, path), output_of(request, path)});
    refuse_options(request, runs.back());
  }
  if (request.plan) return runs;
  if (speaks(processes)) {
    make_output_folder(request);
    for (const Run& run : runs) check_writable(run.output);
  }
  for (Run& run : runs) set_start(request, run);
  return runs;
}

std::string farewell(const RunRequest& request) {
  return fmt::format(
      "cosys-sim: interrupted (by a signal) what was counted is in the result file; "
      "the same command with {}--resume goes on\n",
      request.time_budget_s > 0 ? "what was chosen in place of --time-budget, and " : "");
}

/// What the runs start from, for the members of a process group to compare.
std::string start_of(const std::vector<Run>& runs) {
  std::string text;
  for (const Run& run : runs) {
    text += run.scenario.text + result_digest(run.result);
    for (const std::string& checkpoint : run.checkpoints) text += digest_of(checkpoint);
  }
  return text;
}

}  // namespace

PartRoots part_roots(const ScenarioOptions& options, const fs::path& scenario) {
  PartRoots roots = {scenario.has_parent_path() ? scenario.parent_path() : fs::path(".")};
  roots.insert(roots.end(), options.parts.begin(), options.parts.end());
  return roots;
}

LoadedScenario load_with(const ScenarioOptions& options, const fs::path& scenario) {
  LoadedScenario loaded = load_scenario(scenario, options.overrides, part_roots(options, scenario));
  check_experiment(loaded);
  return loaded;
}

void refuse_other_than_link(const LoadedScenario& scenario, const std::string& command) {
  const std::string& experiment = scenario.base.experiment;
  if (experiment != "link")
    throw bad_input(scenario.path.string(),
                    "an experiment \"" + experiment + "\" has no trials of a link",
                    command + " takes links; use run");
}

LoadedScenario load_link(const ScenarioOptions& options, const fs::path& scenario,
                         const std::string& command) {
  LoadedScenario loaded = load_with(options, scenario);
  refuse_other_than_link(loaded, command);
  return loaded;
}

ExitCode run_command(const RunRequest& request) {
  const std::unique_ptr<ProcessGroup> processes = join_process_group();
  std::vector<Run> runs;
  const bool ready = collective(processes.get(), [&] { runs = prepare(request, processes.get()); });
  if (!ready) return ExitCode::done;
  const ExperimentOptions options{.threads = threads_for(request.threads),
                                  .profiled = request.profile,
                                  .processes = processes.get(),
                                  .interrupt = &heed_stop_signals()};
  if (request.plan) {
    for (const Run& run : runs)
      if (!print_plan(request, run.scenario, *options.interrupt)) return ExitCode::interrupted;
    return ExitCode::done;
  }
  if (!agree(processes.get(), start_of(runs))) return ExitCode::done;
  for (const Run& run : runs) {
    if (is_interrupted(options)) break;
    if (const ExperimentEngine* engine = engine_of(run.scenario))
      run_other(request, run, *engine, processes.get());
    else if (speaks(processes.get()))
      run_scenario(request, run, options);
    else
      run_experiment(run.scenario, run.result, options);
  }
  if (!is_interrupted(options)) return ExitCode::done;
  if (speaks(processes.get())) say(farewell(request));
  return ExitCode::interrupted;
}

}  // namespace sim
